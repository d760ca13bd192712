// Makes solids from the recipe's [[field]] entries; the registry of their kinds.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "recipe/build/build_gradings.h"
#include "recipe/inputs/read_solid.h"

namespace lamella {

/// Returns the axes rotated about x, then y, then z, by angles in degrees; right angles give whole numbers.
glm::dmat3 exact_axes(dvec3 degrees);

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

}  // namespace lamella
