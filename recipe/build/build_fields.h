// Makes solids from the recipe's [[field]] entries; the registry of their kinds.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/mesh/mesh_repair.h"
#include "recipe/build/build_gradings.h"

namespace lamella {

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
};

/// Returns the axes rotated about x, then y, then z, by angles in degrees; right angles give whole numbers.
glm::dmat3 exact_axes(dvec3 degrees);

/// Reads a mesh file, places it and closes it. Throws InputError when it cannot be read or is empty.
SolidMesh read_closed_mesh(const std::string& path, LengthUnit unit, double scale, const Placement& place,
                           std::optional<MeshReport>& report);

/// Reads a mesh file as a solid. Throws InputError when it cannot be read or is empty.
FieldPtr read_solid(const std::string& path, LengthUnit unit, double scale, const Placement& place,
                    std::optional<MeshReport>& report);

/// Dimensions of a shape with a closed form, mm: `size` of a box, the others of round shapes.
struct ShapeSizes {
    double radius = 0;
    dvec3 size{0};
    double height = 0;
    double tube = 0;
};
FieldPtr make_shape(Shape shape, const ShapeSizes& sizes, const Placement& place);

/// Makes the solid of a [[field]], turned about the origin by orthogonal axes. A formula without bounds is
/// cut off by the box `within` around the turned part if it is given; otherwise its bounds are found by a
/// search. A mesh fills in the report. Throws InputError when a file cannot be read or the solid is empty.
FieldPtr build_field(const FieldRecipe& field, Gradings& gradings, const std::optional<Box>& within,
                     std::optional<MeshReport>& report, const glm::dmat3& axes = glm::dmat3(1));

/// The inputs from which a [[field]] is made.
struct FieldBuildContext {
    const FieldRecipe& recipe;
    Gradings& gradings;
    const std::optional<Box>& within;
    Placement place;
    std::optional<MeshReport>& report;
};

/// A kind of [[field]]: its keys and its factory.
struct FieldBuilder {
    Kind kind;
    FieldPtr (*make)(const FieldBuildContext&);
};
std::span<const FieldBuilder> field_builders();

/// Returns the signed volume that a closed mesh encloses, mm^3.
double enclosed_volume(const TriangleMesh& mesh);

}  // namespace lamella
