// Mesh files as solids.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "engine/field/field.h"
#include "engine/mesh/mesh_repair.h"
#include "recipe/recipe.h"

namespace lamella {

class InputCache;

/// Facts about a mesh file.
struct MeshReport {
    std::string path;
    std::size_t vertices = 0;
    std::size_t triangles = 0;
    std::size_t caps = 0;            ///< triangles added to close holes
    bool oriented_manifold = false;  ///< closed and consistently oriented
    double volume = 0;               ///< enclosed, mm^3
    std::vector<std::string> notes;  ///< repairs, and parts of the file that were ignored
};

/// Rotation or mirror about a solid's origin by orthogonal axes, followed by a translation (mm).
struct Placement {
    glm::dmat3 axes{1};
    dvec3 at{0};

    bool operator==(const Placement&) const = default;
};

/// A mesh file, and what is made of it.
struct SolidSource {
    std::string path;
    LengthUnit unit = LengthUnit::mm;  ///< where the file states none
    double scale = 1;                  ///< after the unit
    Placement place{};

    bool operator==(const SolidSource&) const = default;
};

/// Reads a mesh file, places it and closes it. Throws InputError when it cannot be read or is empty.
SolidMesh read_closed_mesh(const SolidSource& source, std::optional<MeshReport>& report);

/// Reads a mesh file as a solid; one that `cache`, which may be null, holds already is not read again. Throws
/// InputError when it cannot be read or is empty.
FieldPtr read_solid(const SolidSource& source, std::optional<MeshReport>& report,
                    InputCache* cache = nullptr);

/// Returns the signed volume that a closed mesh encloses, mm^3.
double enclosed_volume(const TriangleMesh& mesh);

}  // namespace lamella
