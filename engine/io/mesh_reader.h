// Reads triangle meshes from STL, OBJ, PLY and 3MF files.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/mesh/mesh.h"

namespace lamella {

/// A mesh as stored in its file: equal corners are welded into one vertex; nothing is closed or reoriented
/// yet.
struct MeshFile {
    TriangleMesh mesh;
    std::vector<std::string> notes;  ///< defects that were repaired or left out; sentences for the user
};

struct MeshReadOptions {
    double unit_mm = 1.0;  ///< millimetres per number of the file; 3MF states its own unit and ignores this
};

/// Reads a mesh. The format follows from the content first, from the extension second. Throws InputError with
/// one message (path, line or byte where known) when the file yields no triangle.
///
///     const MeshFile file = read_mesh("part.stl", {.unit_mm = 25.4});  // a file in inches
///     for (const std::string& note : file.notes) std::puts(note.c_str());
///     SolidMesh solid = close_mesh(file.mesh, "part.stl");             // mesh/mesh_repair.h
///     const FieldPtr part = make_mesh_field(std::move(solid));         // mesh/mesh_field.h
///     const bool inside = part->value({0, 0, 5}) < 0;
MeshFile read_mesh(const std::string& path, const MeshReadOptions& options = {});

/// Reads a mesh from a file in memory; `name` is used in messages and gives the extension.
MeshFile read_mesh(std::string_view name, std::span<const std::byte> bytes,
                   const MeshReadOptions& options = {});

}  // namespace lamella
