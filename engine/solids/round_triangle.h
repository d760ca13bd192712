// A round triangle: the convex hull of three balls. The atom of walls, graded skins and plates.
#pragma once

#include <array>
#include <optional>

#include "engine/base/geometry.h"
#include "engine/solids/beam.h"

namespace lamella {

/// The convex hull of three balls, mm; radii >= 0. One ball may hold another, and corners may coincide or lie
/// on a line: what is left is a beam or a ball.
struct RoundTriangle {
    std::array<dvec3, 3> corners;
    std::array<double, 3> radii;
    friend bool operator==(const RoundTriangle&, const RoundTriangle&) = default;
};

/// Signed distance from p to the surface, mm; exact on both sides (it is the least distance to the balls
/// about the triangle's points, with the radius interpolated between the corners).
double signed_distance(const RoundTriangle& triangle, dvec3 p);

/// The interval in which the line p + t * direction (direction of unit length) lies inside.
std::optional<Interval> cut(const RoundTriangle& triangle, dvec3 p, dvec3 direction);

/// The bounding box, exact.
Box bounds(const RoundTriangle& triangle);

/// The round cone along the edge that leaves a corner (0, 1 or 2).
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

/// The hull of the six points in which the two planes that touch all three balls touch them. With the three
/// edge beams it makes up the round triangle. Empty where no plane touches all three balls, or two that are
/// one to a millionth of a radian: there the beams alone do.
std::optional<Wedge> wedge(const RoundTriangle& triangle);

/// The points of the round triangle whose nearest ball (weighted by radius) stands on the triangle's face and
/// that lie behind it; the front is the side from which the corners run counter-clockwise. Its last three
/// half-spaces belong to the edges and contain them. The first one lies `front` mm (>= 0) before the face.
std::optional<Wedge> inner_wedge(const RoundTriangle& triangle, double front);

/// The interval in which a line lies inside a wedge.
std::optional<Interval> cut(const Wedge& wedge, dvec3 p, dvec3 direction);

}  // namespace lamella
