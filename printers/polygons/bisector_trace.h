// Medial axis of a piece, traced from a corner.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "printers/polygons/medial_axis.h"

namespace lamella {

/// Computes the medial axis inside simple rings, an outer one and holes in it, whose interior lies on the
/// left. From a corner on, each bisector of two sites of the border is followed, in closed form, to the site
/// that it meets first; a grid of the sites leads to those nearby. Lengths are in any unit in which 1e-4 and
/// the distance of two meetings, 1, are small beside `tolerance`, that of chords of curved pieces. Returns
/// nothing for rings that cross or touch, and where rounding hides which site comes first.
std::optional<MedialAxis> trace_medial_axis(std::span<const std::vector<dvec2>> rings, double tolerance);

}  // namespace lamella
