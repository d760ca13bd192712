// Elements and the bridges between them as a solid.
#pragma once

#include <optional>

#include "procedural/elements/element_plan.h"
#include "procedural/elements/element_shape.h"

namespace lamella {

/// Returns the union of a plan's elements and its bridges, `width` mm wide. With `upright`, they are prisms
/// between these heights, mm, as in make_element_field(). With a body, whose surface the elements lie on,
/// bridges go through the skin at right angles to it.
FieldPtr element_solid(std::vector<ElementShapePtr> shapes, const ElementPlan& plan, double width,
                       std::optional<Interval> upright, const Field* body = nullptr);

}  // namespace lamella
