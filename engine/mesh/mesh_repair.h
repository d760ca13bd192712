// Repairs any triangle mesh into the closed surface of a solid.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "engine/mesh/mesh.h"

namespace lamella {

/// A mesh without boundary: every directed edge (u, v) occurs as often as (v, u). Its winding number is
/// therefore an integer everywhere off the surface, and a plane cuts it in closed polygons, whatever the
/// input was.
struct SolidMesh {
    TriangleMesh mesh;
    std::size_t caps = 0;  ///< triangles appended to mesh.triangles to close holes
    bool oriented_manifold =
        false;  ///< each edge has exactly two triangles, running along it oppositely; no caps
    std::vector<std::string> notes;  ///< repairs made; sentences for the user
};

/// Closes a mesh (mm). Steps, in order: degenerate triangles are removed; copies are removed, and pairs of
/// triangles back to back cancel; border vertices that nearly coincide are joined; neighbours are oriented
/// alike; the remaining boundary is capped; sheets without volume are removed; bodies that are inside out are
/// flipped. Triangles of zero area with three distinct corners stay if they hold their neighbours together.
/// Deterministic. Throws InputError("name: ...") when the triangles enclose no volume.
SolidMesh close_mesh(TriangleMesh mesh, std::string_view name = "mesh");

}  // namespace lamella
