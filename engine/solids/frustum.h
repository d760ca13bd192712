// Frustum and HalfBall: pieces of beams that end flat, or with half a ball.
#pragma once

#include <optional>

#include "engine/base/geometry.h"

namespace lamella {

/// A cone cut off flat at both ends: the disc at `a` with radius `ra`, the disc at `b` with radius `rb`, and
/// what lies between them, mm. The ends must differ.
struct Frustum {
    dvec3 a;
    double ra;
    dvec3 b;
    double rb;
};

/// The half of a ball on the side of its centre to which the unit vector `way` points, mm.
struct HalfBall {
    dvec3 center;
    double radius;
    dvec3 way;
};

/// Return the exact signed distance from p to the surface, mm.
double signed_distance(const Frustum& frustum, dvec3 p);
double signed_distance(const HalfBall& half, dvec3 p);

/// Return the interval of t in which the line p + t * direction (direction of unit length) lies inside. Of
/// the flat ends, a line that lies in one belongs to `a` and to the half ball's disc, not to `b`.
std::optional<Interval> cut(const Frustum& frustum, dvec3 p, dvec3 direction);
std::optional<Interval> cut(const HalfBall& half, dvec3 p, dvec3 direction);

/// Return the exact bounding box.
Box bounds(const Frustum& frustum);
Box bounds(const HalfBall& half);

}  // namespace lamella
