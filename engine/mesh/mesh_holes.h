// Closes the net boundary of a mesh: cuts it into loops and caps them.
#pragma once

#include <cstddef>

#include "engine/mesh/mesh.h"

namespace lamella {

/// Makes the mesh a chain without boundary: afterwards every directed edge (u, v) occurs as often as (v, u).
/// The net boundary of any set of triangles is a cycle; it is cut into simple loops, and each is triangulated
/// against its direction. No vertex is added. O(n log n) in the length of the boundary. Returns how many
/// triangles were appended.
std::size_t cap_holes(TriangleMesh& mesh);

/// The holes that the last `caps` triangles of a mesh close.
struct Holes {
    std::size_t wide = 0;  ///< visible holes
    std::size_t hairlines =
        0;  ///< thinner than 1e-4 of the bounding box's diagonal, as T-junctions leave them
};
Holes holes_under(const TriangleMesh& mesh, std::size_t caps);

}  // namespace lamella
