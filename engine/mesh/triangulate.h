// Triangulation of a closed loop of points in space.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/geometry.h"

namespace lamella {

/// Appends n - 2 triangles (as indices into `loop`) whose boundary is exactly the loop, in its direction. The
/// loop may be concave and need not be flat; no vertex is added. Short loops get the triangulation of least
/// area (Barequet and Sharir 1995, Filling gaps in the boundary of a polyhedron, section 4); long ones are
/// triangulated by ear clipping in their mean plane, shortest diagonal first. Appends nothing for fewer than
/// three points.
void triangulate_loop(std::span<const dvec3> loop, std::vector<std::array<std::uint32_t, 3>>& out);

}  // namespace lamella
