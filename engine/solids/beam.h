// A beam: the convex hull of two balls (a round cone). The atom of foams, frames and supports.
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

/// Signed distance from p to the beam's surface, mm; exact.
double signed_distance(const Beam& beam, dvec3 p);

/// The interval in which the line p + t * direction (direction of unit length) lies inside the beam.
std::optional<Interval> cut(const Beam& beam, dvec3 p, dvec3 direction);

/// The beam's bounding box, exact.
inline Box bounds(const Beam& beam) {
    return {glm::min(beam.a - beam.ra, beam.b - beam.rb), glm::max(beam.a + beam.ra, beam.b + beam.rb)};
}

}  // namespace lamella
