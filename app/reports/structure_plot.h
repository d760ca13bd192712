// A chart of a search's steps, and the shape with its loads and supports.
#pragma once

#include <string>

#include "procedural/optimization/density_shape.h"
#include "recipe/structure/structure_report.h"

namespace lamella {

/// Returns both as SVG, side by side: compliance (with a picture, appearance) and volume over the steps; the
/// solid share along the line of sight, with an arrow in the direction of the force at loaded nodes and a dot
/// at held ones, at most 12 and 60 of them. A plate is seen from above, a solid from the front (from -y).
/// The report is that of a search, with one step or more. `grid` holds the densities in `box`, of a foam or
/// above 0.5 where it is solid.
std::string structure_svg(const std::string& title, const StructureReport& report, const DensityGrid& grid,
                          const Box& box, bool is_foam);

}  // namespace lamella
