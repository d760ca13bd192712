// Bisectors of two sites of a border, for the medial axis: polynomials of a parameter, along which the
// differences of distances to sites, or of their squares, are quadratic at most.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>

#include "engine/base/geometry.h"

namespace lamella {

/// Of places on the border, in the unit of the sites.
inline constexpr double border_rounding = 1e-4;

/// A segment of the border; or a corner where it turns right, which has no length.
struct BorderSite {
    dvec2 a{0}, b{0};
    dvec2 along{0};  ///< unit vector from a to b
    bool corner = false;
    std::size_t before = 0, after = 0;  ///< its neighbours on the ring

    dvec2 nearest(dvec2 p) const {
        if (corner) return a;
        return a + along * std::clamp(dot(p - a, along), 0.0, length(b - a));
    }
    /// Returns the signed distance of a point to the segment's line.
    double height(dvec2 p) const { return dot(p - a, left_of(along)); }
};

/// c0 + c1 s + c2 s^2
struct Quadratic {
    double c0 = 0, c1 = 0, c2 = 0;

    double at(double s) const { return c0 + s * (c1 + s * c2); }
    Quadratic operator-() const { return {-c0, -c1, -c2}; }

    /// Returns the first place from s on where the values are not positive; infinity where they stay so, or
    /// where they are not at s, but rise.
    double first_end(double s) const;
};

/// The points as far from one site, on the left, as from another one, on the right, in the order in which the
/// nearest points move on along the border on the right, and back on the left.
struct Bisector {
    const BorderSite *left = nullptr, *right = nullptr;
    dvec2 p0{0}, p1{0}, p2{0};  ///< p0 + p1 s + p2 s^2
    double r0 = 0, r1 = 0;      ///< of two segments: distance r0 + r1 s
    double half = 0;            ///< of two corners: distance sqrt(half^2 + s^2)
    double height = 0;          ///< of a corner over a segment

    bool of_segments() const { return !left->corner && !right->corner; }
    bool of_corners() const { return left->corner && right->corner; }
    const BorderSite& segment() const { return right->corner ? *left : *right; }
    const BorderSite& corner() const { return right->corner ? *right : *left; }

    dvec2 at(double s) const { return p0 + s * (p1 + s * p2); }
    /// Returns the dot product of the points less `from` with a vector.
    Quadratic component(dvec2 from, dvec2 v) const { return {dot(p0 - from, v), dot(p1, v), dot(p2, v)}; }

    /// Returns the parameter of a point on the bisector.
    double parameter(dvec2 p) const { return dot(p - p0, p1) / dot(p1, p1); }

    /// Returns a rectangle around the discs between two parameters that touch both sites.
    Rect reach(double from, double to) const;
    /// Returns how much farther a site is than those of the bisector: a difference of distances, or of
    /// squares.
    Quadratic farther(const BorderSite& site) const;
};

/// Returns the bisector of two sites through a point; nothing if they have none.
std::optional<Bisector> bisector_of(const BorderSite& left, const BorderSite& right, dvec2 through);

}  // namespace lamella
