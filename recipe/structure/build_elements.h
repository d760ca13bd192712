// Makes the shapes of discrete elements from the recipe's [[element]] entries.
#pragma once

#include <optional>

#include "procedural/elements/element_shape.h"
#include "recipe/build/build_gradings.h"

namespace lamella {

/// Returns the shapes of the recipe, in their order, outlines with the given thickness, mm, or each with its
/// own. Throws InputError, with the entry in front, for files that cannot be read and shapes that are none.
std::vector<ElementShapePtr> build_elements(const Recipe& recipe, std::optional<double> thickness,
                                            Gradings& gradings);

}  // namespace lamella
