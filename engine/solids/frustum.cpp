// Distances in the half-plane through the axis; lines against a slab and a quadric.
#include "engine/solids/frustum.h"

#include <algorithm>
#include <cmath>

namespace lamella {
namespace {

double length_of(dvec3 v) { return std::sqrt(glm::dot(v, v)); }

/// Returns the squared distance from p to the segment from a to b, in the half-plane.
double squared_distance(dvec2 p, dvec2 a, dvec2 b) {
    const dvec2 d = b - a;
    const double square = glm::dot(d, d);
    const double t = square > 0 ? std::clamp(glm::dot(p - a, d) / square, 0.0, 1.0) : 0.0;
    const dvec2 off = p - (a + d * t);
    return glm::dot(off, off);
}

/// Returns the values of t for which lo <= q + t u < hi.
Interval slab(double q, double u, double lo, double hi) {
    if (u == 0) return lo <= q && q < hi ? Interval{-infinity, infinity} : Interval{};
    const double t0 = (lo - q) / u, t1 = (hi - q) / u;
    return {std::min(t0, t1), std::max(t0, t1)};
}

std::optional<Interval> some(double lo, double hi) {
    if (!(lo < hi)) return std::nullopt;
    return Interval{lo, hi};
}

}  // namespace

double signed_distance(const Frustum& frustum, dvec3 p) {
    const dvec3 d = p - frustum.a;
    const double length = length_of(frustum.b - frustum.a);
    const dvec3 axis = (frustum.b - frustum.a) / length;
    const double x = glm::dot(d, axis);
    const dvec2 place(x, length_of(d - axis * x)), low(0, frustum.ra), high(length, frustum.rb);
    const double square = std::min({squared_distance(place, low, high), squared_distance(place, {0, 0}, low),
                                    squared_distance(place, {length, 0}, high)});
    const double radius = frustum.ra + (frustum.rb - frustum.ra) * (x / length);
    const bool inside = x > 0 && x < length && place.y < radius;
    return inside ? -std::sqrt(square) : std::sqrt(square);
}

double signed_distance(const HalfBall& half, dvec3 p) {
    const dvec3 d = p - half.center;
    const double x = glm::dot(d, half.way), radial = length_of(d - half.way * x);
    if (x > 0) {
        const double ball = length_of(d) - half.radius;
        return ball < 0 ? std::max(ball, -x) : ball;
    }
    const double beyond = std::max(radial - half.radius, 0.0);
    return std::sqrt(x * x + beyond * beyond);
}

std::optional<Interval> cut(const Frustum& frustum, dvec3 p, dvec3 direction) {
    const double length = length_of(frustum.b - frustum.a);
    const dvec3 axis = (frustum.b - frustum.a) / length;
    const dvec3 d = p - frustum.a;
    const double u = glm::dot(direction, axis), q = glm::dot(d, axis);
    const Interval between = slab(q, u, 0, length);
    if (between.empty()) return std::nullopt;
    // a t^2 + 2 b t + c <= 0 inside the double cone; within the slab only one of its nappes exists.
    const double slope = (frustum.rb - frustum.ra) / length;
    const dvec3 across = direction - axis * u, off = d - axis * q;
    const double radius = frustum.ra + slope * q, rate = slope * u;
    const double a = glm::dot(across, across) - rate * rate;
    const double b = glm::dot(across, off) - radius * rate;
    const double c = glm::dot(off, off) - radius * radius;
    if (a == 0) {
        if (b == 0) return c <= 0 ? some(between.lo, between.hi) : std::nullopt;
        const double t = -c / (2 * b);
        return b > 0 ? some(between.lo, std::min(between.hi, t)) : some(std::max(between.lo, t), between.hi);
    }
    const double disc = b * b - a * c;
    if (disc < 0) return a > 0 ? std::nullopt : some(between.lo, between.hi);
    // The root of greater magnitude first: the other one follows without cancellation.
    const double far = b >= 0 ? -b - std::sqrt(disc) : -b + std::sqrt(disc);
    const double t0 = far / a, t1 = far == 0 ? 0.0 : c / far;
    const Interval roots{std::min(t0, t1), std::max(t0, t1)};
    if (a > 0) return some(std::max(between.lo, roots.lo), std::min(between.hi, roots.hi));
    // The line is steeper than the cone and inside it beyond both roots, in one nappe each: the frustum is of
    // the nappe whose radius is positive.
    return rate < 0 ? some(between.lo, std::min(between.hi, roots.lo))
                    : some(std::max(between.lo, roots.hi), between.hi);
}

std::optional<Interval> cut(const HalfBall& half, dvec3 p, dvec3 direction) {
    const dvec3 d = p - half.center;
    const Interval beyond = slab(glm::dot(d, half.way), glm::dot(direction, half.way), 0, infinity);
    if (beyond.empty()) return std::nullopt;
    const double b = glm::dot(d, direction);
    const dvec3 off = d - direction * b;
    const double h = half.radius * half.radius - glm::dot(off, off);
    if (!(h > 0)) return std::nullopt;
    const double root = std::sqrt(h);
    return some(std::max(beyond.lo, -b - root), std::min(beyond.hi, -b + root));
}

Box bounds(const Frustum& frustum) {
    const dvec3 axis = (frustum.b - frustum.a) / length_of(frustum.b - frustum.a);
    const dvec3 disc = glm::sqrt(glm::max(dvec3(1.0) - axis * axis, dvec3(0.0)));
    return {glm::min(frustum.a - disc * frustum.ra, frustum.b - disc * frustum.rb),
            glm::max(frustum.a + disc * frustum.ra, frustum.b + disc * frustum.rb)};
}

Box bounds(const HalfBall& half) {
    Box box{half.center, half.center};
    for (int i = 0; i < 3; ++i) {
        const double disc = std::sqrt(std::max(1 - half.way[i] * half.way[i], 0.0));
        box.lo[i] -= half.radius * (half.way[i] <= 0 ? 1.0 : disc);
        box.hi[i] += half.radius * (half.way[i] >= 0 ? 1.0 : disc);
    }
    return box;
}

}  // namespace lamella
