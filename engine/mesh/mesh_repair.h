// Making any triangle mesh the closed surface of a solid.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "engine/mesh/mesh.h"

namespace lamella {

/// A mesh without boundary: every directed edge (u, v) occurs as often as (v, u). So its winding number is a
/// whole number everywhere off the surface, and a plane cuts it in closed polygons, whatever the mesh was.
struct SolidMesh {
    TriangleMesh mesh;
    std::size_t caps = 0;  ///< triangles added at the end of mesh.triangles to close holes
    bool oriented_manifold =
        false;  ///< each edge has exactly two triangles, running along it oppositely; no caps
    std::vector<std::string> notes;  ///< what was mended; sentences for people
};

/// Closes a mesh (mm). In order: what is no triangle goes; copies go, and pairs of triangles back to back
/// cancel; border corners that nearly coincide are joined; neighbours are made to agree which side is out;
/// the boundary that is left is capped; sheets without volume go; bodies that are inside out are turned.
/// Triangles of zero area with three distinct corners stay where they hold their neighbours together.
/// Deterministic. Throws InputError("name: ...") when the triangles enclose no volume.
SolidMesh close_mesh(TriangleMesh mesh, std::string_view name = "mesh");

}  // namespace lamella
