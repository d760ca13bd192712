// Which points see each other inside polygons with holes.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "printers/polygons/polygons.h"

namespace lamella {

/// Answers by a grid over the edges, exactly: coordinates are Clipper's integers, of up to 10 m.
class PolygonSight {
  public:
    using Point = ClipperLib::IntPoint;

    /// A corner of the border, which has the inside on its left.
    struct Corner {
        Point before, at, after;
    };

    /// Outer polygons counter-clockwise, holes clockwise; borders do not cross, as Clipper makes them.
    explicit PolygonSight(const Polygons& polygons);

    /// Whether a point lies inside or on the border.
    bool contains(Point p) const;
    /// The point itself where it lies inside, else one just inside the border within `reach` units of it.
    std::optional<Point> enter(Point p, double reach) const;
    /// Whether all between two points lies inside and touches no other corner; both must lie inside. Adds the
    /// edges that were looked at to `work`.
    bool sees(Point p, Point q, std::int64_t& work) const;

    /// The corners round which shortest ways bend, those where the inside takes more than a half turn, by x.
    const std::vector<Corner>& bends() const { return bends_; }

    /// > 0 where p lies to the left of the line from a to b, 0 on it.
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

    std::vector<Corner> corners_;  // each with the edge to the next one
    std::vector<Corner> bends_;
    Point origin_{0, 0};  // of the grid
    double cell_ = 1;     // units
    std::int64_t columns_ = 0, rows_ = 0;
    std::vector<std::uint32_t> begin_;  // of each cell's edges
    std::vector<std::uint32_t> edges_;
};

}  // namespace lamella
