// Export of meshes and placed copies of them as 3MF.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "engine/mesh/mesh.h"

namespace lamella {

/// A copy of a mesh: p becomes x * p.x + y * p.y + z * p.z + at.
struct MeshCopy {
    std::size_t mesh = 0;  ///< by number
    dvec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, at{0};
};

/// Writes meshes (mm) as objects of a 3MF model, and one object whose components are the copies (3MF core
/// specification 1.3, section 4.2). Meshes without copies are left out. Coordinates have 5 decimals, matrices
/// 9. `name` is the name of the object, UTF-8; characters that XML cannot represent are dropped. An existing
/// file is replaced once the new one is complete. Equal input gives equal bytes. Throws InputError if there
/// are no copies, FaultError if the file cannot be written.
void write_component_package(const std::filesystem::path& path, std::span<const TriangleMesh> meshes,
                             std::span<const MeshCopy> copies, const std::string& name);

}  // namespace lamella
