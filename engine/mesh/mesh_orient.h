// Which way the triangles of a mesh face.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/mesh/mesh.h"
#include "engine/mesh/mesh_edges.h"

namespace lamella {

/// Turns triangles so that neighbours agree: within a patch (triangles joined through edges that exactly two
/// share) the minority is turned; then whole patches are turned while that lessens the net boundary where
/// three or more triangles meet. Returns how many triangles were turned.
std::size_t agree_on_sides(TriangleMesh& mesh);

/// What each body (triangles joined through edges) of a closed mesh encloses.
struct BodyVolumes {
    std::vector<std::uint32_t> body;  ///< of each triangle
    std::vector<double> volume;       ///< mm3, of each body; negative where it faces inwards
    std::vector<double> area;         ///< mm2, of each body
};
BodyVolumes body_volumes(const TriangleMesh& mesh, const MeshEdges& edges);

/// Turns every body of a closed mesh that is inside out. A body that faces inwards and lies inside another
/// one is a cavity and stays; the bodies inside one that had to be turned turn with it. Returns how many
/// bodies were turned, and updates their volumes.
std::size_t turn_bodies_outwards(TriangleMesh& mesh, BodyVolumes& bodies);

}  // namespace lamella
