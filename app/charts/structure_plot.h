// A chart of a search's steps, and the shape with its loads and supports.
#pragma once

#include <string>

#include "recipe/structure/optimize_part.h"

namespace lamella {

/// Returns both as SVG, side by side: compliance (with a picture, appearance) and volume over the steps; the
/// solid share along the line of sight, with an arrow in the direction of the force at loaded nodes and a dot
/// at held ones, at most 12 and 60 of them. A plate is seen from above, a solid from the front (from -y).
/// The part comes from a search, not from a plan.
std::string structure_svg(const std::string& title, const OptimizedPart& part, bool is_foam);

}  // namespace lamella
