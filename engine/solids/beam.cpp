// Closed forms of the round cone: its distance, and its intersection with a line.
#include "engine/solids/beam.h"

namespace lamella {
namespace {

Interval cut_ball(dvec3 relative, dvec3 direction, double radius) {
    const double b = glm::dot(relative, direction);
    const dvec3 off = relative - direction * b;
    const double h = radius * radius - glm::dot(off, off);
    if (!(h >= 0)) return {};
    const double root = std::sqrt(h);
    return {-b - root, -b + root};
}

/// Returns the part of the line inside the cone between the circles where it touches the two balls; p is
/// relative to the first ball.
Interval cut_frustum(const RoundCone& cone, dvec3 p, dvec3 direction) {
    const double u = glm::dot(direction, cone.axis), q = glm::dot(p, cone.axis);
    const double lo = cone.ra * cone.sine, hi = lo + cone.length * cone.cosine * cone.cosine;
    Interval slab{-infinity, infinity};
    if (u != 0) {
        const double t0 = (lo - q) / u, t1 = (hi - q) / u;
        slab = {std::min(t0, t1), std::max(t0, t1)};
    } else if (q < lo || q > hi) {
        return {};
    }
    // a t^2 + 2 b t + c <= 0 inside the double cone; within the slab only one nappe exists.
    const dvec3 across = direction - cone.axis * u, off = p - cone.axis * q;
    const double cos2 = cone.cosine * cone.cosine, sin2 = cone.sine * cone.sine;
    const double radius = cone.ra - q * cone.sine;
    const double a = glm::dot(across, across) * cos2 - sin2 * u * u;
    const double b = glm::dot(across, off) * cos2 + radius * cone.sine * u;
    const double c = glm::dot(off, off) * cos2 - radius * radius;
    const double disc = b * b - a * c;
    if (a > 0) {
        if (disc < 0) return {};
        const double root = std::sqrt(disc);
        return {std::max(slab.lo, (-b - root) / a), std::min(slab.hi, (-b + root) / a)};
    }
    if (disc <= 0 || a == 0) {
        if (a == 0 && b != 0) {
            const double t = -c / (2 * b);
            return b > 0 ? Interval{slab.lo, std::min(slab.hi, t)} : Interval{std::max(slab.lo, t), slab.hi};
        }
        return c <= 0 || disc < 0 ? slab : Interval{};
    }
    // a < 0: the line is steeper than the cone and inside it beyond both roots; the slab holds one of these
    // parts.
    const double root = std::sqrt(disc);
    const double t0 = (-b + root) / a, t1 = (-b - root) / a;  // t0 < t1
    if (slab.lo <= t0) return {slab.lo, std::min(slab.hi, t0)};
    return {std::max(slab.lo, t1), slab.hi};
}

}  // namespace

double signed_distance(const Beam& beam, dvec3 p) { return signed_distance(RoundCone(beam), p); }

std::optional<Interval> cut(const Beam& beam, dvec3 p, dvec3 direction) {
    const RoundCone cone(beam);
    Interval inside = cut_ball(p - cone.a, direction, cone.ra);
    if (cone.length > 0) {
        inside = unite(inside, cut_ball(p - beam.b, direction, cone.rb));
        const Interval frustum = cut_frustum(cone, p - cone.a, direction);
        if (!frustum.empty()) inside = unite(inside, frustum);
    }
    if (inside.empty()) return std::nullopt;
    return inside;
}

}  // namespace lamella
