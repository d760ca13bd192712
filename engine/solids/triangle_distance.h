// Distances from a point to segments and triangles.
#pragma once

#include "engine/base/geometry.h"

namespace lamella {

/// Returns the squared distance from p to the segment a, a + e; e may be 0.
inline double squared_distance_to_edge(dvec3 p, dvec3 a, dvec3 e) {
    const dvec3 d = p - a;
    const double length = glm::dot(e, e);
    if (!(length > 0)) return squared_length(d);
    const double t = std::min(std::max(glm::dot(d, e) / length, 0.0), 1.0);
    return squared_length(d - e * t);
}

/// Returns the squared distance from p to a triangle: to its face if p projects into it, else to its nearest
/// edge.
inline double squared_distance(dvec3 p, dvec3 a, dvec3 b, dvec3 c) {
    const dvec3 ab = b - a, bc = c - b, ca = a - c;
    const dvec3 n = glm::cross(ab, c - a);
    const double area = glm::dot(n, n);
    const dvec3 beyond(glm::dot(glm::cross(ab, n), p - a), glm::dot(glm::cross(bc, n), p - b),
                       glm::dot(glm::cross(ca, n), p - c));
    // A triangle that is a line but for its rounding has a normal, and a point may be beyond none of its
    // sides.
    const bool inside =
        area > 0 && beyond.x <= 0 && beyond.y <= 0 && beyond.z <= 0 && beyond.x + beyond.y + beyond.z < 0;
    if (inside) {
        const double h = glm::dot(n, p - a);
        return h * h / area;
    }
    return std::min(squared_distance_to_edge(p, a, ab),
                    std::min(squared_distance_to_edge(p, b, bc), squared_distance_to_edge(p, c, ca)));
}

}  // namespace lamella
