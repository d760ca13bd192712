// Bridges are elements of shapes of their own: sticks, or on a surface outlines of sticks.
#include "recipe/structure/element_solid.h"

#include <cmath>
#include <numbers>

#include "procedural/elements/element_field.h"
#include "procedural/skin/surface_walk.h"

namespace lamella {

namespace {

constexpr double longer = 1.001;  // than wide, at least

/// Returns a stick along x with round ends as an outline.
ElementShapePtr flat_stick(double length, double width, double thickness) {
    constexpr int chords = 12;  // of each end
    std::vector<dvec2> corners;
    for (int k = 0; k <= 2 * chords + 1; ++k) {
        const bool is_right = k <= chords;
        const double angle = std::numbers::pi * ((is_right ? k : k - 1) / static_cast<double>(chords) - 0.5);
        const dvec2 middle((is_right ? 0.5 : -0.5) * (length - width), 0);
        corners.push_back(middle + 0.5 * width * dvec2(std::cos(angle), std::sin(angle)));
    }
    return make_outline({corners}, thickness);
}

}  // namespace

FieldPtr element_solid(std::vector<ElementShapePtr> shapes, const ElementPlan& plan, double width,
                       std::optional<Interval> upright, const Field* body) {
    std::vector<PlacedElement> elements = plan.elements;
    for (const ElementBridge& bridge : plan.bridges) {
        const dvec3 way = bridge.to - bridge.from;
        const double far = length(way), whole = std::max(far + width, longer * width);
        const dvec3 along = far > 0 ? way / far : dvec3(1, 0, 0);
        PlacedElement element{.shape = static_cast<std::uint32_t>(shapes.size()),
                              .at = 0.5 * (bridge.from + bridge.to),
                              .turn = shortest_turn({1, 0, 0}, along)};
        if (body == nullptr) {
            shapes.push_back(make_stick(whole, width));
        } else {
            shapes.push_back(flat_stick(whole, width, plan.thickness));
            constexpr double precision = 1e-3;
            if (const auto foot = foot_on_surface(*body, element.at, precision * width)) {
                const dvec3 up = glm::normalize(foot->normal - along * glm::dot(along, foot->normal));
                element.turn = glm::normalize(glm::quat_cast(glm::dmat3(along, glm::cross(up, along), up)));
            }
        }
        elements.push_back(element);
    }
    return make_element_field(std::move(shapes), std::move(elements), upright);
}

}  // namespace lamella
