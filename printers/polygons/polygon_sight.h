// PolygonSight: mutual visibility of points inside polygons with holes.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "printers/polygons/polygons.h"

namespace lamella {

/// Answers visibility queries exactly, with a grid over the edges. Coordinates are Clipper's integers, of up
/// to 10 m.
class PolygonSight {
  public:
    using Point = ClipperLib::IntPoint;

    /// A corner of the border. The interior is on the left of the border.
    struct Corner {
        Point before, at, after;
    };

    /// Outer polygons run counter-clockwise, holes clockwise, and borders must not cross, as in Clipper's
    /// output.
    explicit PolygonSight(const Polygons& polygons);

    /// Returns true if the point lies inside or on the border.
    bool contains(Point p) const;
    /// Returns the point itself if it lies inside, otherwise a point just inside the border within `reach`
    /// units of it, or nothing.
    std::optional<Point> enter(Point p, double reach) const;
    /// Returns true if the segment between two points lies inside and touches no corner other than its ends.
    /// Both points must lie inside. Adds the number of edges examined to `work`.
    bool sees(Point p, Point q, std::int64_t& work) const;

    /// Returns the reflex corners (interior angle above 180 degrees), sorted by x. Shortest paths bend only
    /// there.
    const std::vector<Corner>& bends() const { return bends_; }

    /// Returns > 0 if p lies to the left of the line from a to b, 0 if p lies on it.
    static std::int64_t side(Point a, Point b, Point p) {
        return (b.X - a.X) * (p.Y - a.Y) - (b.Y - a.Y) * (p.X - a.X);
    }

  private:
    void add_ring(const ClipperLib::Path& ring);
    void fill_grid();
    std::int64_t column(double x) const;
    std::int64_t row(double y) const;
    template <typename Visit>
    bool any_cell(Point p, Point q, double margin, Visit visit) const;
    template <typename Visit>
    bool any_edge(Point p, Point q, double margin, Visit visit) const;

    std::vector<Corner> corners_;  // each starts the edge to the next corner
    std::vector<Corner> bends_;
    Point origin_{0, 0};  // corner of the grid
    double cell_ = 1;     // width of a cell, units
    std::int64_t columns_ = 0, rows_ = 0;
    std::vector<std::uint32_t> begin_;  // first entry of each cell in edges_
    std::vector<std::uint32_t> edges_;
};

}  // namespace lamella
