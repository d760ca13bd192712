// From the recipe's part to its body: a mesh, a shape or a field.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/build_gradings.h"
#include "engine/mesh.h"

namespace lamella {

/// What was found in the mesh file.
struct MeshReport {
    std::string path;
    std::size_t vertices = 0;
    std::size_t triangles = 0;
    std::size_t caps = 0;            ///< triangles added to close holes
    bool oriented_manifold = false;  ///< closed and consistently oriented
    double volume = 0;               ///< enclosed, mm^3
    std::vector<std::string> notes;  ///< what was mended or left out
};

/// The part's outside. A mesh fills in the report. Throws InputError when a file cannot be read or the body
/// is empty.
FieldPtr build_body(const Recipe& recipe, Gradings& gradings, std::optional<MeshReport>& report);

/// A kind of [[field]]: its keys, and how it is made.
struct FieldBuilder {
    Kind kind;
    FieldPtr (*make)(const FieldRecipe&, Gradings&);
};
std::span<const FieldBuilder> field_builders();

/// Signed volume that a closed mesh encloses, mm^3.
double enclosed_volume(const TriangleMesh& mesh);

}  // namespace lamella
