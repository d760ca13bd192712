// From the recipe's [[field]] entries to solids: kinds are registered here, a line each.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/mesh/mesh.h"
#include "recipe/build/build_gradings.h"

namespace lamella {

/// What was found in a mesh file.
struct MeshReport {
    std::string path;
    std::size_t vertices = 0;
    std::size_t triangles = 0;
    std::size_t caps = 0;            ///< triangles added to close holes
    bool oriented_manifold = false;  ///< closed and consistently oriented
    double volume = 0;               ///< enclosed, mm^3
    std::vector<std::string> notes;  ///< what was mended or left out
};

/// Where a solid goes: turned about its origin, then moved.
struct Placement {
    glm::dmat3 axes{1};
    dvec3 at{0};
};

/// The solid of a mesh file. Throws InputError when it cannot be read or is empty.
FieldPtr read_solid(const std::string& path, LengthUnit unit, double scale, const Placement& place,
                    std::optional<MeshReport>& report);

/// A shape with a closed form; sizes in mm, `size` of a box, the others of what is round.
struct ShapeSizes {
    double radius = 0;
    dvec3 size{0};
    double height = 0;
    double tube = 0;
};
FieldPtr make_shape(Shape shape, const ShapeSizes& sizes, const Placement& place);

/// The solid of a [[field]]. A formula without bounds is cut off by the box `within`, if there is one;
/// otherwise bounds are searched. A mesh fills in the report. Throws InputError when a file cannot be read or
/// the solid is empty.
FieldPtr build_field(const FieldRecipe& field, Gradings& gradings, const std::optional<Box>& within,
                     std::optional<MeshReport>& report);

/// A [[field]] in the making.
struct FieldBuildContext {
    const FieldRecipe& recipe;
    Gradings& gradings;
    const std::optional<Box>& within;
    Placement place;
    std::optional<MeshReport>& report;
};

/// A kind of [[field]]: its keys, and how it is made.
struct FieldBuilder {
    Kind kind;
    FieldPtr (*make)(const FieldBuildContext&);
};
std::span<const FieldBuilder> field_builders();

/// Signed volume that a closed mesh encloses, mm^3.
double enclosed_volume(const TriangleMesh& mesh);

}  // namespace lamella
