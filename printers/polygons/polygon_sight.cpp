// Visibility by a grid of edges and the signs of triangle areas.
#include "printers/polygons/polygon_sight.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace lamella {
namespace {

using Point = PolygonSight::Point;
using Corner = PolygonSight::Corner;

constexpr auto side = PolygonSight::side;

/// Returns true if b, which lies on the line through a and c, lies strictly between them.
bool between(Point a, Point b, Point c) {
    if (b == a || b == c) return false;
    return std::min(a.X, c.X) <= b.X && b.X <= std::max(a.X, c.X) && std::min(a.Y, c.Y) <= b.Y &&
           b.Y <= std::max(a.Y, c.Y);
}

bool opposite(std::int64_t a, std::int64_t b) { return (a < 0 && b > 0) || (a > 0 && b < 0); }

bool is_bend(const Corner& c) { return side(c.before, c.at, c.after) < 0; }

/// Returns true if the points near a corner in the direction of q are inside or on the border.
bool opens_to(const Corner& c, Point q) {
    const bool left_before = side(c.before, c.at, q) >= 0, left_after = side(c.at, c.after, q) >= 0;
    return is_bend(c) ? left_before || left_after : left_before && left_after;
}

/// Returns true if a corner, or the edge from it to the next one, blocks the line of sight.
bool blocks(const Corner& c, Point p, Point q) {
    if (c.at == p) return !opens_to(c, q);
    if (c.at == q) return !opens_to(c, p);
    const std::int64_t at = side(p, q, c.at), after = side(p, q, c.after);
    if (at == 0 && between(p, c.at, q)) return true;
    const std::int64_t of_p = side(c.at, c.after, p), of_q = side(c.at, c.after, q);
    if (of_p == 0 && between(c.at, p, c.after)) return of_q < 0;
    if (of_q == 0 && between(c.at, q, c.after)) return of_p < 0;
    return opposite(at, after) && opposite(of_p, of_q);
}

dvec2 to_vector(Point p) { return {static_cast<double>(p.X), static_cast<double>(p.Y)}; }

/// Returns the unit vector to the left of the direction from a to b.
dvec2 left_of(Point a, Point b) {
    const dvec2 way = to_vector(b) - to_vector(a);
    return dvec2(-way.y, way.x) / std::sqrt(way.x * way.x + way.y * way.y);
}

/// Removes points on a straight line between their neighbours.
std::vector<Point> without_flat_corners(const ClipperLib::Path& ring) {
    std::vector<Point> kept;
    for (const Point& p : ring) {
        while (kept.size() >= 2 && side(kept[kept.size() - 2], kept.back(), p) == 0) kept.pop_back();
        if (kept.empty() || kept.back() != p) kept.push_back(p);
    }
    while (kept.size() >= 3 && side(kept[kept.size() - 2], kept.back(), kept.front()) == 0) kept.pop_back();
    while (kept.size() >= 3 && side(kept.back(), kept[0], kept[1]) == 0) kept.erase(kept.begin());
    return kept;
}

}  // namespace

PolygonSight::PolygonSight(const Polygons& polygons) {
    for (const ClipperLib::Path& ring : polygons) add_ring(ring);
    std::ranges::copy_if(corners_, std::back_inserter(bends_), is_bend);
    std::ranges::stable_sort(bends_, {}, [](const Corner& c) { return c.at.X; });
    fill_grid();
}

void PolygonSight::add_ring(const ClipperLib::Path& ring) {
    const std::vector<Point> points = without_flat_corners(ring);
    const std::size_t n = points.size();
    if (n < 3) return;
    for (std::size_t i = 0; i < n; ++i)
        corners_.push_back({points[(i + n - 1) % n], points[i], points[(i + 1) % n]});
}

/// Builds a grid with about one cell per edge.
void PolygonSight::fill_grid() {
    if (corners_.empty()) return;
    Rect box;
    for (const Corner& c : corners_) box = unite(box, Rect{to_vector(c.at), to_vector(c.at)});
    origin_ = {static_cast<ClipperLib::cInt>(box.lo.x), static_cast<ClipperLib::cInt>(box.lo.y)};
    const dvec2 size = box.hi - box.lo + dvec2(1);
    const auto count = static_cast<double>(corners_.size());
    cell_ = std::max(std::sqrt(size.x * size.y / count), std::max(size.x, size.y) / count);
    columns_ = static_cast<std::int64_t>(size.x / cell_) + 1;
    rows_ = static_cast<std::int64_t>(size.y / cell_) + 1;
    const auto each = [&](auto visit) {
        for (std::uint32_t i = 0; i < corners_.size(); ++i) {
            any_cell(corners_[i].at, corners_[i].after, 1, [&](std::size_t cell) {
                visit(cell, i);
                return false;
            });
        }
    };
    begin_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
    each([&](std::size_t cell, std::uint32_t) { ++begin_[cell + 1]; });
    for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
    edges_.resize(begin_.back());
    std::vector<std::uint32_t> next = begin_;
    each([&](std::size_t cell, std::uint32_t edge) { edges_[next[cell]++] = edge; });
}

std::int64_t PolygonSight::column(double x) const {
    const double at = std::floor((x - static_cast<double>(origin_.X)) / cell_);
    return static_cast<std::int64_t>(std::clamp(at, 0.0, static_cast<double>(columns_ - 1)));
}

std::int64_t PolygonSight::row(double y) const {
    const double at = std::floor((y - static_cast<double>(origin_.Y)) / cell_);
    return static_cast<std::int64_t>(std::clamp(at, 0.0, static_cast<double>(rows_ - 1)));
}

/// Visits the cells within `margin` of a segment, row by row, until `visit` returns true.
template <typename Visit>
bool PolygonSight::any_cell(Point p, Point q, double margin, Visit visit) const {
    const dvec2 lo = to_vector(p.Y < q.Y ? p : q), hi = to_vector(p.Y < q.Y ? q : p);
    const std::int64_t last = row(hi.y + margin);
    for (std::int64_t r = row(lo.y - margin); r <= last; ++r) {
        const double bottom = static_cast<double>(origin_.Y) + static_cast<double>(r) * cell_;
        const auto x_at = [&](double y) {
            if (hi.y == lo.y) return y < lo.y ? lo.x : hi.x;
            return lo.x + (hi.x - lo.x) * std::clamp((y - lo.y) / (hi.y - lo.y), 0.0, 1.0);
        };
        const double a = x_at(bottom - margin), b = x_at(bottom + cell_ + margin);
        const std::int64_t end = column(std::max(a, b) + margin);
        for (std::int64_t c = column(std::min(a, b) - margin); c <= end; ++c) {
            if (visit(static_cast<std::size_t>(r * columns_ + c))) return true;
        }
    }
    return false;
}

/// Visits the edges in these cells, some of them more than once.
template <typename Visit>
bool PolygonSight::any_edge(Point p, Point q, double margin, Visit visit) const {
    if (corners_.empty()) return false;
    return any_cell(p, q, margin, [&](std::size_t cell) {
        for (std::uint32_t i = begin_[cell]; i < begin_[cell + 1]; ++i) {
            if (visit(edges_[i])) return true;
        }
        return false;
    });
}

bool PolygonSight::contains(Point p) const {
    if (corners_.empty()) return false;
    const Point right{origin_.X + static_cast<ClipperLib::cInt>(cell_ * static_cast<double>(columns_)), p.Y};
    if (p.X < origin_.X || p.X > right.X || p.Y < origin_.Y) return false;
    std::vector<std::uint32_t> edges;
    any_edge(p, right, 1, [&](std::uint32_t edge) {
        edges.push_back(edge);
        return false;
    });
    std::ranges::sort(edges);
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    bool in = false;
    for (const std::uint32_t edge : edges) {
        const Point a = corners_[edge].at, b = corners_[edge].after;
        const std::int64_t s = side(a, b, p);
        if (p == a || (s == 0 && between(a, p, b))) return true;
        const bool up = a.Y <= p.Y && p.Y < b.Y, down = b.Y <= p.Y && p.Y < a.Y;
        if ((up && s > 0) || (down && s < 0)) in = !in;
    }
    return in;
}

std::optional<PolygonSight::Point> PolygonSight::enter(Point p, double reach) const {
    if (contains(p)) return p;
    constexpr double step_in = 10;  // units; after rounding the nearest point itself may lie outside
    double least = reach;
    std::optional<dvec2> nearest;
    const dvec2 from = to_vector(p);
    any_edge(p, p, reach + 1, [&](std::uint32_t edge) {
        const Corner& c = corners_[edge];
        const dvec2 a = to_vector(c.at), way = to_vector(c.after) - a, arm = from - a;
        const double t =
            std::clamp((arm.x * way.x + arm.y * way.y) / (way.x * way.x + way.y * way.y), 0.0, 1.0);
        const dvec2 foot = a + way * t, gap = foot - from;
        const double distance = std::sqrt(gap.x * gap.x + gap.y * gap.y);
        if (t == 1 || distance > least) return false;  // the far end belongs to the next edge
        dvec2 inward = left_of(c.at, c.after);
        if (t == 0) inward += left_of(c.before, c.at);
        least = distance;
        nearest = foot + inward * (step_in / std::sqrt(inward.x * inward.x + inward.y * inward.y));
        return false;
    });
    if (!nearest) return std::nullopt;
    const Point in{std::llround(nearest->x), std::llround(nearest->y)};
    return contains(in) ? std::optional(in) : std::nullopt;
}

bool PolygonSight::sees(Point p, Point q, std::int64_t& work) const {
    return p == q || !any_edge(p, q, 1, [&](std::uint32_t edge) {
               ++work;
               return blocks(corners_[edge], p, q);
           });
}

}  // namespace lamella
