// Gradings by distance to points, segments and planes, and falloff functions of a distance.
#pragma once

#include <vector>

#include "engine/field/grading.h"

namespace lamella {

/// A point, segment or plane that a distance is measured to, mm.
struct Attractor {
    enum class Kind { point, segment, plane };
    Kind kind = Kind::point;
    dvec3 a{0.0};  ///< the point, an end of the segment, or a point of the plane
    dvec3 b{0.0};  ///< the other end, or the plane's normal (any non-zero length)
};

/// Returns the distance to the nearest attractor, mm. A single plane has a signed distance: positive on the
/// side that its normal points to. Points and segments are found through a tree; planes are all evaluated.
/// Throws InputError for an empty list, coordinates that are not finite or beyond 1e9, or a normal of length
/// 0; messages count attractors from 1.
GradingPtr make_distance_grading(std::vector<Attractor> attractors);

/// How a number changes from `near` to `far`: number = far + (near - far) * w, with t = distance / radius.
enum class Falloff {
    linear,    ///< w = 1 - t, 0 from the radius on
    smooth,    ///< w = 1 - t^2 (3 - 2 t), 0 from the radius on
    gaussian,  ///< w = exp(-4.5 t^2): the radius is three standard deviations, where 1.1 % is left
    inverse    ///< w = 1 / (1 + t): half-way at the radius
};

/// Returns a number that depends on a distance: near_value at distances of 0 or less; at `radius` (mm) and
/// beyond it far_value, or approaching it, depending on the falloff. NaN where the distance is NaN. Throws
/// InputError for numbers that are not finite and a radius that is not positive.
GradingPtr make_falloff_grading(GradingPtr distance, double near_value, double far_value, double radius,
                                Falloff falloff);

}  // namespace lamella
