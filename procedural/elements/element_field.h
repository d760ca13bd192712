// Placed elements as a field.
#pragma once

#include <optional>
#include <vector>

#include "procedural/elements/element_shape.h"
#include "procedural/elements/placed_element.h"

namespace lamella {

/// Returns the union of elements. A plane's runs come from the shapes' own cuts, and cost what the elements
/// that meet the plane cost, however many there are. With `upright`, elements are prisms between these two
/// heights, mm, over the section of their shapes with the xy plane, and turned about z alone. Throws
/// InputError for an element that names no shape.
FieldPtr make_element_field(std::vector<ElementShapePtr> shapes, std::vector<PlacedElement> elements,
                            std::optional<Interval> upright = std::nullopt);

}  // namespace lamella
