// Simplifies polylines and fits arcs greedily.
#include "printers/polygons/path_fit.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace lamella {
namespace {

constexpr double largest_radius = 1000;   // mm; flatter arcs become lines: firmware computes in floats
constexpr std::size_t fewest_points = 4;  // any three points lie on a circle
constexpr std::size_t max_points = 512;   // most points replaced by one arc; bounds the work

double distance_to_segment(dvec2 p, dvec2 a, dvec2 b) {
    const dvec2 way = b - a;
    const double square = dot(way, way);
    const double t = square > 0 ? std::clamp(dot(p - a, way) / square, 0.0, 1.0) : 0.0;
    return length(p - (a + way * t));
}

double run_between(std::span<const dvec2> points, std::size_t first, std::size_t last) {
    double sum = 0;
    for (std::size_t i = first; i < last; ++i) sum += length(points[i + 1] - points[i]);
    return sum;
}

PathPiece straight(std::span<const dvec2> points, std::size_t first, std::size_t last) {
    return {points[last], dvec2(0), 0, length(points[last] - points[first]),
            run_between(points, first, last)};
}

/// Returns the inner point of a stretch that is farthest from its line, if that is farther than the
/// tolerance. Where the stretch returns to where it began, a loop smaller than the tolerance keeps its
/// farthest point: it would have no length otherwise. 0: none.
std::size_t point_to_keep(std::span<const dvec2> points, std::size_t first, std::size_t last,
                          double tolerance) {
    constexpr double no_length = 2e-3;  // mm; G-code has three decimals
    const bool returns = length(points[last] - points[first]) < no_length;
    std::size_t farthest = 0;
    double most = returns ? std::min(tolerance, no_length) : tolerance;
    for (std::size_t i = first + 1; i < last; ++i) {
        const double d = distance_to_segment(points[i], points[first], points[last]);
        if (d > most) {
            most = d;
            farthest = i;
        }
    }
    return farthest;
}

/// Appends straight pieces from one point to another, with as few points between as the tolerance permits.
void append_merged(std::span<const dvec2> points, std::size_t first, std::size_t last, double tolerance,
                   std::vector<PathPiece>& out) {
    std::vector<std::size_t> ends{last};  // ends of stretches to be examined, the next one last
    while (!ends.empty()) {
        const std::size_t farthest = point_to_keep(points, first, ends.back(), tolerance);
        if (farthest > 0) {
            ends.push_back(farthest);
            continue;
        }
        out.push_back(straight(points, first, ends.back()));
        first = ends.back();
        ends.pop_back();
    }
}

struct Arc {
    dvec2 center;
    double radius;
    int turn;
    double sweep;  // radians, positive
};

std::optional<dvec2> circle_center(dvec2 a, dvec2 b, dvec2 c) {
    const dvec2 u = b - a, v = c - a;
    const double twice = 2 * cross(u, v);
    if (std::abs(twice) < 1e-12) return std::nullopt;
    const double uu = dot(u, u), vv = dot(v, v);
    return a + dvec2(v.y * uu - u.y * vv, u.x * vv - v.x * uu) / twice;
}

/// Returns an arc from the first to the last point that passes all others, if there is one.
std::optional<Arc> fit_arc(std::span<const dvec2> points, double tolerance, double unit) {
    const auto on_grid = [&](dvec2 p) {
        return dvec2(std::round(p.x / unit), std::round(p.y / unit)) * unit;
    };
    const dvec2 from = on_grid(points.front()), to = on_grid(points.back());
    auto center = circle_center(from, points[points.size() / 2], to);
    if (!center) return std::nullopt;
    center = from + on_grid(*center - from);
    const double radius = length(from - *center);
    if (!(radius > 2 * tolerance && radius < largest_radius)) return std::nullopt;
    if (std::abs(length(to - *center) - radius) > 2 * unit) return std::nullopt;
    const int turn = cross(points[1] - points[0], points[2] - points[1]) > 0 ? 1 : -1;
    double sweep = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const dvec2 arm = points[i] - *center;
        if (std::abs(length(arm) - radius) > tolerance) return std::nullopt;
        if (i + 1 == points.size()) break;
        const dvec2 next = points[i + 1] - *center;
        const double angle = turn * std::atan2(cross(arm, next), dot(arm, next));
        if (!(angle > 0)) return std::nullopt;
        // The chord's largest distance from the circle: its sagitta plus the deviation of its ends.
        const dvec2 middle = (arm + next) / 2.0;
        if (radius - length(middle) > tolerance) return std::nullopt;
        sweep += angle;
    }
    if (sweep > pi) return std::nullopt;
    return Arc{*center, radius, turn, sweep};
}

}  // namespace

std::vector<PathPiece> straight_pieces(std::span<const dvec2> points) {
    std::vector<PathPiece> out;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) out.push_back(straight(points, i, i + 1));
    return out;
}

std::vector<PathPiece> merged_pieces(std::span<const dvec2> points, double tolerance) {
    std::vector<PathPiece> out;
    if (points.size() > 1) append_merged(points, 0, points.size() - 1, tolerance, out);
    return out;
}

std::vector<PathPiece> arc_pieces(std::span<const dvec2> points, double tolerance, bool merge, double unit) {
    std::vector<PathPiece> out;
    std::size_t pending = 0;  // start of the points that are not yet appended
    const auto flush = [&](std::size_t to) {
        if (to == pending) return;
        if (merge) return append_merged(points, pending, to, tolerance, out);
        for (std::size_t i = pending; i < to; ++i) out.push_back(straight(points, i, i + 1));
    };
    std::size_t at = 0;
    while (at + 1 < points.size()) {
        std::optional<Arc> best;
        std::size_t end = at;
        for (std::size_t last = at + fewest_points - 1; last < points.size() && last - at < max_points;
             ++last) {
            const auto arc = fit_arc(points.subspan(at, last - at + 1), tolerance, unit);
            if (!arc) break;
            best = arc;
            end = last;
        }
        if (!best) {
            ++at;
            continue;
        }
        flush(at);
        out.push_back({points[end], best->center, best->turn, best->radius * best->sweep,
                       run_between(points, at, end)});
        at = pending = end;
    }
    flush(points.size() - (points.empty() ? 0 : 1));
    return out;
}

}  // namespace lamella
