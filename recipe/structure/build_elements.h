// Makes the shapes of discrete elements from the recipe's [[element]] entries.
#pragma once

#include "procedural/elements/element_shape.h"
#include "recipe/build/build_gradings.h"

namespace lamella {

/// Returns the shapes of the recipe, in their order. In a plate (elements.dimensions = 2), outlines are so
/// thick that it makes no difference; `bounds` are the part's, mm. Throws InputError, with the entry in
/// front, for files that cannot be read and shapes that are none.
std::vector<ElementShapePtr> build_elements(const Recipe& recipe, const Box& bounds, Gradings& gradings);

}  // namespace lamella
