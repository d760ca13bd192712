// A torus around the z axis, and the parts of lines inside it.
#pragma once

#include <vector>

#include "engine/base/geometry.h"

namespace lamella {

/// All points at most `small` from a circle of radius `large` about the origin, in the plane z = 0, mm.
/// 0 < small < large.
struct Torus {
    double large = 0;
    double small = 0;
};

double signed_distance(const Torus& torus, dvec3 p);
Box bounds(const Torus& torus);

/// Appends the parts of the line p + t * direction inside the torus, as intervals of t, sorted and disjoint.
/// With t counted from the point of the line that is nearest to the middle, the line is inside where a
/// quartic without a cubic term is negative:
///     (|q|^2 + R^2 - r^2)^2 - 4 R^2 (q_x^2 + q_y^2) = t^4 + c2 t^2 + c1 t + c0.
void cut(const Torus& torus, dvec3 p, dvec3 direction, std::vector<Interval>& inside);

}  // namespace lamella
