// Polygon offsets and booleans in millimetres: what toolpaths need of Clipper.
#pragma once

#include <clipper.hpp>
#include <vector>

#include "engine/base/geometry.h"
#include "engine/contours/contours.h"

namespace lamella {

/// Polygons in units of 10 nm: outer ones counter-clockwise, holes clockwise. Coordinates of up to 10 m stay
/// in Clipper's fast range.
using Polygons = ClipperLib::Paths;

inline constexpr double polygon_scale = 1e5;  ///< units per mm

ClipperLib::Path to_polygon(const std::vector<dvec2>& points);
/// A layer's contours, one polygon each.
Polygons to_polygons(const std::vector<Contour>& contours);
std::vector<dvec2> to_points(const ClipperLib::Path& polygon);

/// Area, mm^2; holes count negative.
double area_of(const Polygons& polygons);
/// Sum of the lengths of the borders, mm.
double perimeter_of(const Polygons& polygons);

/// Grown (by > 0, round corners) or shrunk (by < 0, sharp corners), mm.
Polygons offset_polygons(const Polygons& polygons, double by);
/// Shrunk by `radius` mm, which may be far more than what is thin: in steps, of which the first take that
/// away. (The offset of a foam's outlines by more than their distance has crossings without number.)
Polygons erode_polygons(const Polygons& polygons, double radius);
/// a less b.
Polygons subtract_polygons(const Polygons& a, const Polygons& b);
/// What lies in either.
Polygons unite_polygons(const Polygons& a, const Polygons& b);
/// What lies in both.
Polygons intersect_polygons(const Polygons& a, const Polygons& b);

/// A closed polygon and how many others enclose it.
struct NestedPolygon {
    ClipperLib::Path polygon;
    int depth = 0;
};
/// The borders of the polygons' union, each enclosed one behind what encloses it.
std::vector<NestedPolygon> nested_polygons(const Polygons& polygons);

/// Stretches of the rings that lie inside the polygons, as open lines; a ring that lies inside entirely ends
/// where it begins.
std::vector<ClipperLib::Path> rings_inside(const Polygons& rings, const Polygons& polygons);
/// All that lies within `reach` mm of the lines.
Polygons around_lines(const std::vector<ClipperLib::Path>& lines, double reach);

/// One entry for each connected piece, with its holes.
std::vector<Polygons> split_pieces(const Polygons& polygons);
/// With fewer points: none that is left out lies farther than `tolerance` mm from the new border. Rings that
/// shrink to less than a triangle are dropped.
Polygons simplified(const Polygons& polygons, double tolerance);

/// A stretch of a line, mm.
struct Segment {
    dvec2 a;
    dvec2 b;
    double length() const;
};

/// Extent of the polygons along a direction of unit length, mm.
Interval extent(const Polygons& polygons, dvec2 direction);
/// The stretches inside the polygons of the lines along `direction` whose distance from the origin, to the
/// left of the direction, is first + k * pitch for 0 <= k < count; line by line.
std::vector<Segment> cut_lines(const Polygons& polygons, dvec2 direction, double first, double pitch,
                               int count);
/// The longest of some stretches inside the polygons along their principal axis.
Segment longest_chord(const Polygons& polygons);

}  // namespace lamella
