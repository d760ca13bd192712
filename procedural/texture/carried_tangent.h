// Parallel transport of tangents between neighbouring normals.
#pragma once

#include "engine/base/geometry.h"

namespace lamella {

/// Returns the tangent at one normal as it is at another one, turned the shortest way; the tangent itself for
/// nearly opposite normals. All are unit vectors.
inline dvec3 carried_tangent(dvec3 tangent, dvec3 from, dvec3 to) {
    constexpr double opposite = -0.99;
    const double cosine = glm::dot(from, to);
    if (cosine < opposite) return tangent;
    const dvec3 axis = glm::cross(from, to);
    return tangent * cosine + glm::cross(axis, tangent) + axis * (glm::dot(axis, tangent) / (1 + cosine));
}

}  // namespace lamella
