// Printable roofs: the extent of a cavity in the layer below a known one, so that its roof prints without
// supports.
#pragma once

#include "engine/runs/runs.h"

namespace lamella {

/// Lengths in run units.
struct RoofRule {
    double step = run_unit;       ///< distance by which solid may stand out over the layer below
    double row_pitch = run_unit;  ///< from row to row; at most `step`, or roofs slope along the rows only
    double min_wall = 0;          ///< least thickness of solid left between parts of a cavity
};

/// Returns the cavity of a layer, within `inside`, if the layer above has the cavity `above` (rows of equal
/// number). Solid above the result is within a step of solid beside it: the erosion of the result by a disc
/// of radius `step` lies within `above`.
///
/// A connected part of `inside` becomes cavity as a whole if that is allowed. Otherwise its cavity is the
/// cavity above, dilated by a step, united with the part eroded by the least distance that leaves nothing
/// hanging. This distance grows by a step from layer to layer upward, which makes hip roofs where the inside
/// has a flat ceiling of any shape; they begin where the border is farthest. Solid that is too thin to be
/// held from its sides is continued downward as a wall, where parts of a cavity would otherwise meet below
/// it.
///
/// After Hornus, Lefebvre, Dumas and Claux 2016, who bound enclosures by such steps; the hip roofs and the
/// walls are ours. The largest cavity is not unique, and this one is not always among the largest.
RunRows cavity_below(const RunRows& above, const RunRows& inside, const RoofRule& rule);

}  // namespace lamella
