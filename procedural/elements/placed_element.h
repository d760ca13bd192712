// PlacedElement: where a copy of a shape is, how it is turned, and how large it is.
#pragma once

#include <glm/gtc/quaternion.hpp>

#include "engine/base/geometry.h"

namespace lamella {

/// Maps p of the shape's frame to at + scale * turn * p.
struct PlacedElement {
    std::uint32_t shape = 0;      ///< by number
    dvec3 at{0};                  ///< mm
    glm::dquat turn{1, 0, 0, 0};  ///< of length 1
    double scale = 1;

    dvec3 local(dvec3 p) const { return glm::conjugate(turn) * (p - at) / scale; }
    dvec3 local_direction(dvec3 way) const { return glm::conjugate(turn) * way / scale; }
    friend bool operator==(const PlacedElement&, const PlacedElement&) = default;
};

/// Returns the element turned by a small rotation about an axis through its place: the vector's direction and
/// its length in radians, to the third order.
inline PlacedElement turned(PlacedElement element, dvec3 rotation) {
    const dvec3 half = 0.5 * rotation;
    element.turn = glm::normalize(glm::dquat(1, half.x, half.y, half.z) * element.turn);
    return element;
}

}  // namespace lamella
