// Reading triangle meshes from STL, OBJ, PLY and 3MF files.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/mesh/mesh.h"

namespace lamella {

/// A mesh as its file gives it: equal corners welded into one vertex, nothing closed or turned yet.
struct MeshFile {
    TriangleMesh mesh;
    std::vector<std::string> notes;  ///< what was wrong and has been mended or left out; sentences for people
};

struct MeshReadOptions {
    double unit_mm = 1.0;  ///< millimetres per number of the file; 3MF states its own unit and ignores this
};

/// Reads a mesh, deciding by the content first and by the extension second which format it is.
/// Throws InputError with one message (path, line or byte where known) when no triangle can be had.
MeshFile read_mesh(const std::string& path, const MeshReadOptions& options = {});

/// The same for a file that is in memory already; `name` stands in messages and gives the extension.
MeshFile read_mesh(std::string_view name, std::span<const std::byte> bytes,
                   const MeshReadOptions& options = {});

}  // namespace lamella
