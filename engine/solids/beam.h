// Beam: the convex hull of two balls (a round cone). Foams, frames and supports are made of beams.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/base/geometry.h"

namespace lamella {

/// The convex hull of the ball at `a` with radius `ra` and the ball at `b` with radius `rb`, mm.
struct Beam {
    dvec3 a;
    double ra;
    dvec3 b;
    double rb;
    friend bool operator==(const Beam&, const Beam&) = default;
};

/// Returns the exact signed distance from p to the beam's surface, mm.
double signed_distance(const Beam& beam, dvec3 p);

/// A beam in the frame of its axis, for many distances from it: length, direction and half-angle of its cone.
/// When one ball contains the other, the beam is that ball and the length is 0.
struct RoundCone {
    dvec3 a, b, axis;
    double ra, rb, length, sine, cosine;

    explicit RoundCone(const Beam& beam)
        : a(beam.a), b(beam.b), axis(0), ra(beam.ra), rb(beam.rb), length(0), sine(0), cosine(1) {
        const dvec3 d = beam.b - beam.a;
        const double l = std::sqrt(glm::dot(d, d));
        if (l <= std::abs(ra - rb)) {
            if (rb > ra) a = beam.b;
            ra = rb = std::max(ra, rb);
            return;
        }
        length = l;
        axis = d / l;
        sine = (ra - rb) / l;
        cosine = std::sqrt(1 - sine * sine);
    }
};

/// Returns the exact signed distance from p to the surface, mm.
inline double signed_distance(const RoundCone& cone, dvec3 p) {
    const dvec3 d = p - cone.a;
    if (cone.length == 0) return std::sqrt(glm::dot(d, d)) - cone.ra;
    const double x = glm::dot(d, cone.axis);
    const dvec3 off = d - cone.axis * x;
    const double radial = std::sqrt(glm::dot(off, off));
    const double foot = x * cone.cosine - radial * cone.sine;
    if (foot < 0) return std::sqrt(glm::dot(d, d)) - cone.ra;
    if (foot > cone.length * cone.cosine) {
        const dvec3 e = p - cone.b;
        return std::sqrt(glm::dot(e, e)) - cone.rb;
    }
    return radial * cone.cosine + x * cone.sine - cone.ra;
}

/// The form of a beam from which distances are quick.
inline RoundCone prepared(const Beam& beam) { return RoundCone(beam); }

/// Returns the interval of t in which the line p + t * direction (direction of unit length) lies inside the
/// beam.
std::optional<Interval> cut(const Beam& beam, dvec3 p, dvec3 direction);

/// Returns the beam's exact bounding box.
inline Box bounds(const Beam& beam) {
    return {glm::min(beam.a - beam.ra, beam.b - beam.rb), glm::max(beam.a + beam.ra, beam.b + beam.rb)};
}

}  // namespace lamella
