// Bridges are elements of shapes of their own: sticks, or on a surface outlines of sticks.
#include "recipe/structure/element_solid.h"

#include "procedural/elements/element_field.h"
#include "procedural/elements/element_surface.h"
#include "procedural/skin/surface_walk.h"

namespace lamella {

FieldPtr element_solid(std::vector<ElementShapePtr> shapes, const ElementPlan& plan, double width,
                       std::optional<Interval> upright, const Field* body) {
    std::vector<PlacedElement> elements = plan.elements;
    for (const ElementBridge& bridge : plan.bridges) {
        PlacedElement rod = bridge_rod(bridge);
        rod.shape = static_cast<std::uint32_t>(shapes.size());
        const double whole = bridge_length(bridge, width);
        if (body == nullptr) {
            shapes.push_back(make_stick(whole, width));
        } else {
            constexpr double tolerance = 0.005, precision = 1e-3;  // mm, and of the width
            shapes.push_back(make_outline({stick_outline(whole, width, tolerance)}, plan.thickness + whole));
            if (const auto foot = foot_on_surface(*body, rod.at, precision * width)) {
                const dvec3 along = rod.turn * dvec3(1, 0, 0),
                            up = glm::normalize(foot->normal - along * glm::dot(along, foot->normal));
                rod.turn = glm::normalize(glm::quat_cast(glm::dmat3(along, glm::cross(up, along), up)));
            }
        }
        elements.push_back(rod);
    }
    return make_element_field(std::move(shapes), std::move(elements), upright);
}

}  // namespace lamella
