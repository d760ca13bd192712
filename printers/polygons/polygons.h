// Polygons: offsets, booleans and measures of polygons in millimetres, on top of Clipper.
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
/// Converts a layer's contours, one polygon each.
Polygons to_polygons(const std::vector<Contour>& contours);
std::vector<dvec2> to_points(const ClipperLib::Path& polygon);
/// Converts the borders of the polygons' union to contours, each after the one that encloses it.
std::vector<Contour> to_contours(const Polygons& polygons);

/// Returns the area, mm^2; holes count negative.
double area_of(const Polygons& polygons);
/// Returns the total length of the borders, mm.
double perimeter_of(const Polygons& polygons);

/// Dilates (by > 0, round corners) or erodes (by < 0, sharp corners) by a distance in mm.
Polygons offset_polygons(const Polygons& polygons, double by);
/// Erodes by `radius` mm, which may far exceed the thickness of thin parts. It works in steps, the first of
/// which remove the thin parts: a single offset of a foam's outlines by more than their distance has an
/// excessive number of self-intersections.
Polygons erode_polygons(const Polygons& polygons, double radius);
/// Returns a minus b.
Polygons subtract_polygons(const Polygons& a, const Polygons& b);
/// Returns the union.
Polygons unite_polygons(const Polygons& a, const Polygons& b);
/// Returns the intersection.
Polygons intersect_polygons(const Polygons& a, const Polygons& b);

/// A closed polygon and the number of polygons that enclose it.
struct NestedPolygon {
    ClipperLib::Path polygon;
    int depth = 0;
};
/// Returns the borders of the polygons' union. Each border follows the one that encloses it.
std::vector<NestedPolygon> nested_polygons(const Polygons& polygons);

/// Returns the parts of the rings that lie inside the polygons, as open lines. A ring that lies inside
/// entirely ends at its start.
std::vector<ClipperLib::Path> rings_inside(const Polygons& rings, const Polygons& polygons);
/// Returns all points within `reach` mm of the lines.
Polygons around_lines(const std::vector<ClipperLib::Path>& lines, double reach);

/// Returns one entry per connected piece, with its holes.
std::vector<Polygons> split_pieces(const Polygons& polygons);
/// Removes points. No omitted point lies farther than `tolerance` mm from the new border. Drops rings that
/// shrink to less than a triangle.
Polygons simplified(const Polygons& polygons, double tolerance);

/// A segment of a line, mm.
struct Segment {
    dvec2 a;
    dvec2 b;
    double length() const;
};

/// Returns the extent of the polygons along a unit vector, mm.
Interval extent(const Polygons& polygons, dvec2 direction);
/// Cuts lines by the polygons and returns the segments inside, line by line. The lines run along `direction`.
/// Line k (0 <= k < count) lies at a distance of first + k * pitch from the origin, to the left of the
/// direction.
std::vector<Segment> cut_lines(const Polygons& polygons, dvec2 direction, double first, double pitch,
                               int count);
/// Returns the longest of some sample chords of the polygons along their principal axis.
Segment longest_chord(const Polygons& polygons);

}  // namespace lamella
