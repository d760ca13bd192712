// Orientation of the triangles of a mesh.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/mesh/mesh.h"
#include "engine/mesh/mesh_edges.h"

namespace lamella {

/// Flips triangles so that neighbours agree. Within a patch (triangles connected through edges with exactly
/// two triangles) the minority is flipped; then whole patches are flipped while this reduces the net boundary
/// where three or more triangles meet. Returns how many triangles were flipped.
std::size_t agree_on_sides(TriangleMesh& mesh);

/// Volume and area of each body (triangles connected through edges) of a closed mesh.
struct BodyVolumes {
    std::vector<std::uint32_t> body;  ///< of each triangle
    std::vector<double> volume;       ///< mm3, of each body; negative if it faces inwards
    std::vector<double> area;         ///< mm2, of each body
};
BodyVolumes body_volumes(const TriangleMesh& mesh, const MeshEdges& edges);

/// Flips every body of a closed mesh that is inside out. A body that faces inwards and lies inside another
/// one is a cavity and stays; bodies inside a flipped one are flipped with it. Returns how many bodies were
/// flipped, and updates their volumes.
std::size_t turn_bodies_outwards(TriangleMesh& mesh, BodyVolumes& bodies);

}  // namespace lamella
