// Sharp edges of a body, beside which both faces are solid where one is.
#pragma once

#include <vector>

#include "procedural/texture/surface_sites.h"

namespace lamella {

/// Sets SurfaceSites::over_edge of the sites up to `width` mm from a convex edge.
void set_over_edges(SurfaceSites& sites, double width);

/// Makes the pattern solid beside an edge where it is solid on the edge's other face. What is wide over an
/// edge can be a wedge in space: each face's pattern ends where the other face is nearer. `values` are by
/// site, above 0 in the solid.
void share_over_edges(const SurfaceSites& sites, std::vector<float>& values);

}  // namespace lamella
