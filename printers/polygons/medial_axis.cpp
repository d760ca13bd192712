// Traces the axis, and where that fails extracts the part of the border's Voronoi diagram that lies inside.
#include "printers/polygons/medial_axis.h"

#include <algorithm>
#include <boost/polygon/segment_data.hpp>
#include <boost/polygon/voronoi.hpp>
#include <cmath>
#include <limits>
#include <optional>

#include "printers/polygons/bisector_trace.h"

namespace lamella {
namespace {

using Coordinate = std::int32_t;
using BorderPoint = boost::polygon::point_data<Coordinate>;
using BorderSegment = boost::polygon::segment_data<Coordinate>;
using Diagram = boost::polygon::voronoi_diagram<double>;

dvec2 to_vector(const BorderPoint& p) { return {p.x(), p.y()}; }

/// Places in steps of 1 um from the first point of a piece. The steps are coarser than the polygons' own and
/// the numbers small, because exact arithmetic is faster with fewer digits.
class AxisGrid {
  public:
    explicit AxisGrid(const Polygons& piece) : origin_(piece.front().front()) {}

    BorderPoint point(const ClipperLib::IntPoint& p) const {
        return {steps(p.X - origin_.X), steps(p.Y - origin_.Y)};
    }
    dvec2 to_mm(dvec2 p) const {
        return (p * units + dvec2(static_cast<double>(origin_.X), static_cast<double>(origin_.Y))) /
               polygon_scale;
    }
    static double to_mm(double steps) { return steps * units / polygon_scale; }
    static double from_mm(double mm) { return mm * polygon_scale / units; }

  private:
    static constexpr double units = 100;  // of polygons, in a step

    static Coordinate steps(ClipperLib::cInt of_polygons) {
        return static_cast<Coordinate>(std::floor(static_cast<double>(of_polygons) / units + 0.5));
    }

    ClipperLib::IntPoint origin_;
};

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
    AxisBuilder(const Polygons& piece, double tolerance)
        : grid_(piece), tolerance_(AxisGrid::from_mm(tolerance)) {
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
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    void add_ring(const ClipperLib::Path& ring) {
        const std::size_t n = ring.size(), first = segments_.size();
        const auto point = [&](std::size_t i) { return grid_.point(ring[i % n]); };
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
                piece.left[end] = grid_.to_mm(l);
                piece.right[end] = grid_.to_mm(r);
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

    std::uint32_t new_node(dvec2 at, const Site& site) {
        axis_.nodes.push_back({grid_.to_mm(at), AxisGrid::to_mm(length(at - site.nearest(at)))});
        return static_cast<std::uint32_t>(axis_.nodes.size() - 1);
    }
    std::uint32_t node_at(const Diagram::vertex_type* vertex, dvec2 at, const Site& site) {
        std::uint32_t& node = node_of_[static_cast<std::size_t>(vertex - diagram_.vertices().data())];
        if (node == none) node = new_node(at, site);
        return node;
    }

    AxisGrid grid_;
    double tolerance_;  // grid steps
    std::vector<BorderSegment> segments_;
    std::vector<bool> turns_right_;  ///< at the first point of each segment
    std::vector<std::size_t> next_;  ///< next segment of the same ring
    Diagram diagram_;
    std::vector<std::uint32_t> node_of_;
    MedialAxis axis_;
};

}  // namespace

std::optional<MedialAxis> traced_medial_axis(const Polygons& piece, double tolerance) {
    if (piece.empty() || piece.front().empty()) return MedialAxis();
    const AxisGrid grid(piece);
    std::vector<std::vector<dvec2>> rings;
    for (const ClipperLib::Path& path : piece) {
        std::vector<dvec2>& ring = rings.emplace_back();
        for (const ClipperLib::IntPoint& point : path) {
            const dvec2 p = to_vector(grid.point(point));
            if (ring.empty() || p != ring.back()) ring.push_back(p);
        }
        while (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
    }
    auto axis = trace_medial_axis(rings, AxisGrid::from_mm(tolerance));
    if (!axis) return axis;
    for (MedialNode& node : axis->nodes) node = {grid.to_mm(node.at), AxisGrid::to_mm(node.radius)};
    for (MedialEdge& edge : axis->edges) {
        for (const std::size_t end : {0U, 1U}) {
            edge.left[end] = grid.to_mm(edge.left[end]);
            edge.right[end] = grid.to_mm(edge.right[end]);
        }
    }
    return axis;
}

MedialAxis medial_axis(const Polygons& piece, double tolerance) {
    if (auto axis = traced_medial_axis(piece, tolerance)) return *std::move(axis);
    return AxisBuilder(piece, tolerance).build();
}

}  // namespace lamella
