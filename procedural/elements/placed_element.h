// PlacedElement: where a copy of a shape is, how it is turned, and how large it is.
#pragma once

#include <cmath>
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

/// Returns the rotation by the smallest angle that takes a unit vector to another one.
inline glm::dquat shortest_turn(dvec3 from, dvec3 to) {
    const double cosine = glm::dot(from, to);
    constexpr double opposite = -1 + 1e-12;
    if (cosine > opposite) {
        const dvec3 axis = glm::cross(from, to);
        return glm::normalize(glm::dquat(1 + cosine, axis.x, axis.y, axis.z));
    }
    // Half a round about z, so that vectors of the xy plane stay in it.
    const dvec3 beside = std::abs(from.z) < 0.9 ? dvec3(0, 0, 1) : dvec3(1, 0, 0);
    const dvec3 axis = glm::normalize(beside - from * glm::dot(from, beside));
    return glm::dquat(0, axis.x, axis.y, axis.z);
}

/// Returns the element turned by a small rotation about an axis through its place: the vector's direction and
/// its length in radians, to the third order.
inline PlacedElement turned(PlacedElement element, dvec3 rotation) {
    const dvec3 half = 0.5 * rotation;
    element.turn = glm::normalize(glm::dquat(1, half.x, half.y, half.z) * element.turn);
    return element;
}

}  // namespace lamella
