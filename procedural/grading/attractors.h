// Distances to points, segments and planes, and numbers that fall off with a distance.
#pragma once

#include <vector>

#include "engine/field/grading.h"

namespace lamella {

/// What a grading refers to, mm.
struct Attractor {
    enum class Kind { point, segment, plane };
    Kind kind = Kind::point;
    dvec3 a{0.0};  ///< the point, an end of the segment, a point of the plane
    dvec3 b{0.0};  ///< the other end, or the plane's normal (any length but 0)
};

/// The distance to the nearest attractor, mm. A plane that stands alone has a sign: positive on the side that
/// its normal points to. Points and segments are found through a tree; every plane is looked at.
/// Throws InputError for no attractors, coordinates that are not finite or beyond 1e9, or a normal of length
/// 0; the message counts attractors from 1.
GradingPtr make_distance_grading(std::vector<Attractor> attractors);

/// How a number changes from `near` to `far`; with t = distance / radius, number = far + (near - far) * w.
enum class Falloff {
    linear,    ///< w = 1 - t, 0 from the radius on
    smooth,    ///< w = 1 - t^2 (3 - 2 t), 0 from the radius on
    gaussian,  ///< w = exp(-4.5 t^2): the radius is three standard deviations, where 1.1 % is left
    inverse    ///< w = 1 / (1 + t): half way at the radius
};

/// A number that depends on a distance: near_value where it is 0 or less, far_value from `radius` (mm) on, or
/// ever closer to it. NaN where the distance is NaN. Throws InputError for numbers that are not finite and a
/// radius that is not positive.
GradingPtr make_falloff_grading(GradingPtr distance, double near_value, double far_value, double radius,
                                Falloff falloff);

}  // namespace lamella
