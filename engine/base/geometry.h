// Points, boxes and intervals: the types that all other headers share. Lengths are millimetres.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>

namespace lamella {

using dvec2 = glm::dvec2;
using dvec3 = glm::dvec3;

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double pi = 3.14159265358979323846;

inline double dot(dvec2 a, dvec2 b) { return a.x * b.x + a.y * b.y; }
inline double dot(dvec3 a, dvec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
/// Returns the third component of the cross product: positive where b lies counter-clockwise of a.
inline double cross(dvec2 a, dvec2 b) { return a.x * b.y - a.y * b.x; }
inline double squared_length(dvec2 v) { return dot(v, v); }
inline double squared_length(dvec3 v) { return dot(v, v); }
inline double length(dvec2 v) { return std::sqrt(dot(v, v)); }
inline double length(dvec3 v) { return std::sqrt(dot(v, v)); }
/// Returns the vector rotated by a right angle counter-clockwise.
inline dvec2 left_of(dvec2 v) { return {-v.y, v.x}; }
inline bool is_finite(dvec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// A closed range of values; empty when lo > hi.
struct Interval {
    double lo = infinity;
    double hi = -infinity;

    bool empty() const { return !(lo <= hi); }
    bool contains(double v) const { return lo <= v && v <= hi; }
    double width() const { return hi - lo; }
};

/// An axis-aligned rectangle in a layer's plane, mm; empty when a lower corner exceeds the upper one.
struct Rect {
    dvec2 lo{infinity};
    dvec2 hi{-infinity};

    bool empty() const { return !(lo.x <= hi.x && lo.y <= hi.y); }
    dvec2 size() const { return hi - lo; }
    dvec2 center() const { return (lo + hi) * 0.5; }
};

/// An axis-aligned box, mm; empty when a lower corner exceeds the upper one.
struct Box {
    dvec3 lo{infinity};
    dvec3 hi{-infinity};

    bool empty() const { return !(lo.x <= hi.x && lo.y <= hi.y && lo.z <= hi.z); }
    dvec3 size() const { return hi - lo; }
    dvec3 center() const { return (lo + hi) * 0.5; }
    Rect rect() const { return {{lo.x, lo.y}, {hi.x, hi.y}}; }
    bool contains(dvec3 p) const {
        return lo.x <= p.x && p.x <= hi.x && lo.y <= p.y && p.y <= hi.y && lo.z <= p.z && p.z <= hi.z;
    }
    void include(dvec3 p) {
        lo = glm::min(lo, p);
        hi = glm::max(hi, p);
    }
};

/// Return the smallest interval, rectangle or box that holds both.
inline Interval unite(const Interval& a, const Interval& b) {
    return {std::min(a.lo, b.lo), std::max(a.hi, b.hi)};
}
inline Rect unite(const Rect& a, const Rect& b) { return {glm::min(a.lo, b.lo), glm::max(a.hi, b.hi)}; }
inline Rect intersect(const Rect& a, const Rect& b) { return {glm::max(a.lo, b.lo), glm::min(a.hi, b.hi)}; }
inline Box unite(const Box& a, const Box& b) { return {glm::min(a.lo, b.lo), glm::max(a.hi, b.hi)}; }
inline Box intersect(const Box& a, const Box& b) { return {glm::max(a.lo, b.lo), glm::min(a.hi, b.hi)}; }
inline Box grown(const Box& b, double by) { return {b.lo - by, b.hi + by}; }
inline Rect grown(const Rect& r, double by) { return {r.lo - by, r.hi + by}; }

/// Returns the distance between two boxes, 0 where they touch.
inline double distance(const Box& a, const Box& b) {
    const dvec3 d = glm::max(glm::max(a.lo - b.hi, b.lo - a.hi), dvec3(0.0));
    return std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
}

/// Returns the distance from a point to a box, 0 inside.
inline double distance(const Box& b, dvec3 p) { return distance(b, Box{p, p}); }

/// Returns the distance between opposite corners.
inline double diagonal(const Box& b) {
    const dvec3 size = b.size();
    return std::sqrt(size.x * size.x + size.y * size.y + size.z * size.z);
}

}  // namespace lamella
