// Reads a number at every vertex of a PLY mesh: a colour channel or any scalar property.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/mesh/mesh.h"

namespace lamella {

/// A mesh with a number at every vertex. Coincident corners are not welded: each keeps its own number.
struct AttributedMesh {
    TriangleMesh mesh;           ///< mm; polygons are cut into triangles
    std::vector<double> values;  ///< one per vertex, NaN where the file says NaN or infinity
};

/// Reads a mesh and the vertex property named `attribute`: red, green, blue and alpha of an integer type as 0
/// to 1, any other property unchanged. `unit_mm` is mm per number of the file. Throws InputError (path, line
/// or byte where known) when the file is no complete PLY mesh, or lacks the property (the message lists the
/// existing ones).
AttributedMesh read_ply_attribute(const std::string& path, const std::string& attribute,
                                  double unit_mm = 1.0);

/// Reads them from a file in memory; `name` is used in messages.
AttributedMesh read_ply_attribute(std::string_view name, std::span<const std::byte> bytes,
                                  const std::string& attribute, double unit_mm = 1.0);

}  // namespace lamella
