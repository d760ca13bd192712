// Roofs that print without supports: how far a cavity may reach in the layer below one whose cavity is known.
#pragma once

#include "engine/runs/runs.h"

namespace lamella {

/// Lengths in run units.
struct RoofRule {
    double step = run_unit;       ///< by which what is solid may stand out over the layer below
    double row_pitch = run_unit;  ///< from row to row; at most the step, or roofs lean along the rows alone
    double min_wall = 0;          ///< thickness of what is left solid between parts of a cavity
};

/// The cavity of a layer within `inside`, where the layer above has the cavity `above` (rows of equal
/// number). All that is solid above it lies within a step of solid: what a disc of radius `step` leaves of
/// the result, when one stands about each point that is not in it, lies in `above`.
///
/// Each connected part of `inside` becomes cavity wholly where it may. Elsewhere the cavity above grows by a
/// step, and joined to it is as much of the inside as has a distance from its border that grows by a step
/// from layer to layer: hip roofs over flat ceilings, however the inside is shaped, that begin where the
/// border is furthest. Where parts of a cavity would meet below something solid that is too thin to be held
/// from its sides, it stays, as a wall. After Hornus, Lefebvre, Dumas and Claux 2016, who bound enclosures by
/// such steps; the hip roofs and the walls are ours. The largest cavity is not unique, and this one is not
/// always among the largest.
RunRows cavity_below(const RunRows& above, const RunRows& inside, const RoofRule& rule);

}  // namespace lamella
