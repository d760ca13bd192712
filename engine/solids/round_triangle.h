// RoundTriangle: the convex hull of three balls. Walls, graded skins and plates are made of these.
#pragma once

#include <array>
#include <optional>

#include "engine/base/geometry.h"
#include "engine/solids/beam.h"

namespace lamella {

/// The convex hull of three balls, mm; radii >= 0. One ball may contain another, and corners may coincide or
/// be collinear: the shape is then a beam or a ball.
struct RoundTriangle {
    std::array<dvec3, 3> corners;
    std::array<double, 3> radii;
    friend bool operator==(const RoundTriangle&, const RoundTriangle&) = default;
};

/// Returns the exact signed distance from p to the surface, mm, on both sides. It is the least distance to
/// the balls around the triangle's points, with the radius interpolated between the corners.
double signed_distance(const RoundTriangle& triangle, dvec3 p);

/// Returns the interval of t in which the line p + t * direction (direction of unit length) lies inside.
std::optional<Interval> cut(const RoundTriangle& triangle, dvec3 p, dvec3 direction);

/// Returns the exact bounding box.
Box bounds(const RoundTriangle& triangle);

/// Returns the round cone along the edge that starts at a corner (0, 1 or 2).
inline Beam edge_beam(const RoundTriangle& triangle, std::size_t corner) {
    const std::size_t next = (corner + 1) % 3;
    return {triangle.corners[corner], triangle.radii[corner], triangle.corners[next], triangle.radii[next]};
}

/// A convex polyhedron between two triangles: normal * (p - origin) <= limit for five half-spaces with unit
/// normals.
struct Wedge {
    dvec3 origin;
    std::array<dvec3, 5> normals;
    std::array<double, 5> limits;
    std::array<dvec3, 6> corners;  ///< one triangle, then the other, in the same order
};

/// Returns the hull of the six points in which the two planes tangent to all three balls touch them. The
/// round triangle is its union with the three edge beams. Returns nothing when no plane touches all three
/// balls, or when both planes coincide to a millionth of a radian: then the union of the beams suffices.
std::optional<Wedge> wedge(const RoundTriangle& triangle);

/// Returns the points of the round triangle that lie behind its face and whose nearest ball (weighted by
/// radius) is centred in the face; the front is the side from which the corners run counter-clockwise. The
/// last three half-spaces belong to the edges and have the edges on their borders. The first one ends `front`
/// mm (>= 0) before the face.
std::optional<Wedge> inner_wedge(const RoundTriangle& triangle, double front);

/// Returns the interval in which a line lies inside a wedge.
std::optional<Interval> cut(const Wedge& wedge, dvec3 p, dvec3 direction);

}  // namespace lamella
