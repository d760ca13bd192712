// Beam: the convex hull of two balls (a round cone). Foams, frames and supports are made of beams.
#pragma once

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

/// Returns the interval of t in which the line p + t * direction (direction of unit length) lies inside the
/// beam.
std::optional<Interval> cut(const Beam& beam, dvec3 p, dvec3 direction);

/// Returns the beam's exact bounding box.
inline Box bounds(const Beam& beam) {
    return {glm::min(beam.a - beam.ra, beam.b - beam.rb), glm::max(beam.a + beam.ra, beam.b + beam.rb)};
}

}  // namespace lamella
