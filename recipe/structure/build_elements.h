// Makes the shapes of discrete elements from the recipe's [[element]] entries.
#pragma once

#include <optional>

#include "procedural/elements/element_shape.h"
#include "recipe/build/build_gradings.h"

namespace lamella {

/// Returns the polygons of an element that is an outline, from its corners or its drawing, its longer side as
/// long as the recipe says. Throws InputError for a drawing that cannot be read.
std::vector<std::vector<dvec2>> element_outline(const ElementRecipe& element);

/// Returns the shapes of the recipe, in their order, outlines with the given thickness, mm, or each with its
/// own. Throws InputError, with the entry in front, for files that cannot be read and shapes that are none.
std::vector<ElementShapePtr> build_elements(const Recipe& recipe, std::optional<double> thickness,
                                            Gradings& gradings);

/// Returns the shapes of the recipe for each of several thicknesses of outlines: `thickness` mm, and each
/// skin_step times as thick as the one before. Throws as build_elements().
inline constexpr double skin_step = 1.25;
std::vector<ElementShapePtr> skin_shapes(const Recipe& recipe, double thickness, std::size_t steps,
                                         Gradings& gradings);

}  // namespace lamella
