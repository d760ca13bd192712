// Extracts the part of the border's Voronoi diagram that lies inside.
#include "printers/polygons/medial_axis.h"

#include <algorithm>
#include <boost/polygon/segment_data.hpp>
#include <boost/polygon/voronoi.hpp>
#include <cmath>
#include <limits>
#include <optional>

namespace lamella {
namespace {

using Coordinate = std::int32_t;
using BorderPoint = boost::polygon::point_data<Coordinate>;
using BorderSegment = boost::polygon::segment_data<Coordinate>;
using Diagram = boost::polygon::voronoi_diagram<double>;

dvec2 to_vector(const BorderPoint& p) { return {p.x(), p.y()}; }

/// The generator of a Voronoi cell: a segment or a corner of the border, in grid steps.
struct Site {
    dvec2 a{0}, b{0};  ///< a segment, its interior on the left; or a corner, where a equals b
    bool corner = false;
    bool inside = false;  ///< the corner's cell lies inside: the border turns right at the corner

    dvec2 nearest(dvec2 p) const {
        if (corner) return a;
        const dvec2 way = b - a;
        return a + way * std::clamp(dot(p - a, way) / dot(way, way), 0.0, 1.0);
    }
};

class AxisBuilder {
  public:
    /// Coordinates are relative to the piece's first point, because the diagram is faster with small numbers.
    AxisBuilder(const Polygons& piece, double tolerance)
        : origin_(piece.front().front()), tolerance_(tolerance * polygon_scale / grid) {
        for (const ClipperLib::Path& ring : piece) add_ring(ring);
    }

    MedialAxis build() {
        if (segments_.empty()) return {};
        boost::polygon::construct_voronoi(segments_.begin(), segments_.end(), &diagram_);
        node_of_.assign(diagram_.vertices().size(), none);
        for (const Diagram::edge_type& edge : diagram_.edges()) {
            // Each edge appears twice, once in each direction.
            if (&edge > edge.twin() || !edge.is_primary() || edge.is_infinite()) continue;
            const Site left = site_of(*edge.cell()), right = site_of(*edge.twin()->cell());
            if (is_inside(edge, left, right) && !add(edge, left, right)) return {};
        }
        return std::move(axis_);
    }

  private:
    /// Polygon units per step of the diagram's grid (1 um). The grid is coarser than that of the polygons,
    /// because the exact arithmetic is faster with fewer digits.
    static constexpr double grid = 100;
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    void add_ring(const ClipperLib::Path& ring) {
        const std::size_t n = ring.size(), first = segments_.size();
        const auto point = [&](std::size_t i) {
            const ClipperLib::IntPoint& p = ring[i % n];
            return BorderPoint(on_grid(p.X - origin_.X), on_grid(p.Y - origin_.Y));
        };
        for (std::size_t i = 0; i < n; ++i) {
            if (point(i) != point(i + 1)) segments_.emplace_back(point(i), point(i + 1));
        }
        const std::size_t count = segments_.size() - first;
        for (std::size_t i = 0; i < count; ++i) {
            const BorderSegment &before = segments_[first + (i + count - 1) % count],
                                &after = segments_[first + i];
            const dvec2 in = to_vector(before.high()) - to_vector(before.low());
            const dvec2 out = to_vector(after.high()) - to_vector(after.low());
            turns_right_.push_back(cross(in, out) < 0);
            next_.push_back(first + (i + 1) % count);
        }
    }

    Site site_of(const Diagram::cell_type& cell) const {
        const std::size_t i = cell.source_index();
        const dvec2 a = to_vector(segments_[i].low()), b = to_vector(segments_[i].high());
        if (cell.contains_segment()) return {a, b, false, true};
        const bool start = cell.source_category() == boost::polygon::SOURCE_CATEGORY_SEGMENT_START_POINT;
        const dvec2 at = start ? a : b;
        return {at, at, true, turns_right_[start ? i : next_[i]]};
    }

    /// A corner's cell lies entirely inside or outside, and so do its edges. Between two segments the
    /// position of the edge decides.
    static bool is_inside(const Diagram::edge_type& edge, const Site& left, const Site& right) {
        if (left.corner || right.corner) return left.inside && right.inside;
        double side = 0;
        for (const Diagram::vertex_type* v : {edge.vertex0(), edge.vertex1()}) {
            const double s = cross(left.b - left.a, dvec2(v->x(), v->y()) - left.a);
            if (std::abs(s) > std::abs(side)) side = s;
        }
        return side > 0;
    }

    /// Appends an edge. Returns false if the diagram does not belong to this border.
    bool add(const Diagram::edge_type& edge, const Site& left, const Site& right) {
        const dvec2 a(edge.vertex0()->x(), edge.vertex0()->y()), b(edge.vertex1()->x(), edge.vertex1()->y());
        std::vector<dvec2> points{a};
        if (edge.is_curved())
            follow_curve(a, b, left.corner ? left.a : right.a, left.corner ? right : left, points);
        points.push_back(b);
        std::uint32_t from = node_at(edge.vertex0(), a, left);
        for (std::size_t i = 1; i < points.size(); ++i) {
            const bool last = i + 1 == points.size();
            const std::uint32_t to = last ? node_at(edge.vertex1(), b, left) : new_node(points[i], left);
            MedialEdge piece{{from, to}, {}, {}};
            for (const std::size_t end : {0U, 1U}) {
                const dvec2 p = points[i - 1 + end], l = left.nearest(p), r = right.nearest(p);
                constexpr double slack = 1;  // grid steps
                if (std::abs(length(p - l) - length(p - r)) > slack) return false;
                piece.left[end] = to_mm(l);
                piece.right[end] = to_mm(r);
            }
            axis_.edges.push_back(piece);
            from = to;
        }
        return true;
    }

    /// Appends points of the parabola between a focus and a segment, from a to b, both excluded.
    void follow_curve(dvec2 a, dvec2 b, dvec2 focus, const Site& line, std::vector<dvec2>& points) const {
        const dvec2 along = (line.b - line.a) / length(line.b - line.a), up(-along.y, along.x);
        const double height = dot(focus - line.a, up), x0 = dot(a - focus, along), x1 = dot(b - focus, along);
        if (!(std::abs(height) > 0)) return;
        // y = (x^2 + height^2) / (2 height): a chord over dx deviates by dx^2 / (8 |height|).
        const double step = std::sqrt(8 * std::abs(height) * tolerance_);
        const auto count = static_cast<int>(std::clamp(std::ceil(std::abs(x1 - x0) / step), 1.0, 64.0));
        const dvec2 foot = focus - up * height;
        for (int i = 1; i < count; ++i) {
            const double x = x0 + (x1 - x0) * i / count;
            points.push_back(foot + along * x + up * ((x * x + height * height) / (2 * height)));
        }
    }

    static Coordinate on_grid(ClipperLib::cInt units) {
        return static_cast<Coordinate>(std::floor(static_cast<double>(units) / grid + 0.5));
    }
    dvec2 to_mm(dvec2 p) const {
        return (p * grid + dvec2(static_cast<double>(origin_.X), static_cast<double>(origin_.Y))) /
               polygon_scale;
    }
    std::uint32_t new_node(dvec2 at, const Site& site) {
        axis_.nodes.push_back({to_mm(at), length(at - site.nearest(at)) * grid / polygon_scale});
        return static_cast<std::uint32_t>(axis_.nodes.size() - 1);
    }
    std::uint32_t node_at(const Diagram::vertex_type* vertex, dvec2 at, const Site& site) {
        std::uint32_t& node = node_of_[static_cast<std::size_t>(vertex - diagram_.vertices().data())];
        if (node == none) node = new_node(at, site);
        return node;
    }

    ClipperLib::IntPoint origin_;
    double tolerance_;  // grid steps
    std::vector<BorderSegment> segments_;
    std::vector<bool> turns_right_;  ///< at the first point of each segment
    std::vector<std::size_t> next_;  ///< next segment of the same ring
    Diagram diagram_;
    std::vector<std::uint32_t> node_of_;
    MedialAxis axis_;
};

}  // namespace

MedialAxis medial_axis(const Polygons& piece, double tolerance) {
    if (piece.empty() || piece.front().empty()) return {};
    return AxisBuilder(piece, tolerance).build();
}

}  // namespace lamella
