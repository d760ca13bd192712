// A line cut out of a plane's patches; runs by halving the pieces of a period.
#include "procedural/lattice/wall_line.h"

#include <algorithm>

namespace lamella {
namespace {

constexpr int halvings = 2;             // of the pieces of a period
constexpr double end_tolerance = 1e-8;  // turns

/// The cubic with these values and derivatives at 0 and 1.
double hermite(double a, double da, double b, double db, double t) {
    const double u = 1 - t;
    return u * u * ((1 + 2 * t) * a + t * da) + t * t * ((1 + 2 * u) * b - u * db);
}

/// Returns a lower bound of a distance between two nodes, from those at the nodes: it changes by at most 1
/// per radian.
double least_between(double a, double b, double t) {
    return std::max(a - t * WallPlane::step, b - (1 - t) * WallPlane::step);
}

}  // namespace

WallLine::WallLine(const WallPlane& plane, Axis axis, double across) : plane_(&plane), axis_(axis) {
    const double turn = across - std::floor(across), place = turn * parts;
    across_ = sine_cosine(turn * (2 * pi));
    const int j = std::min(static_cast<int>(place), parts - 1);
    const double t = place - j;
    for (int i = 0; i < parts; ++i) {
        const auto node = [&](int row) -> const WallPlane::Node& {
            return axis == Axis::x ? plane.node(i, row) : plane.node(row, i);
        };
        const WallPlane::Node &a = node(j), &b = node(j + 1);
        if (!a.known || !b.known) {
            nodes_[static_cast<std::size_t>(i)].distance =
                least_between(std::abs(a.distance), std::abs(b.distance), t);
            continue;
        }
        nodes_[static_cast<std::size_t>(i)] =
            axis == Axis::x ? Node{hermite(a.distance, a.along_y, b.distance, b.along_y, t),
                                   hermite(a.along_x, a.mixed, b.along_x, b.mixed, t), true}
                            : Node{hermite(a.distance, a.along_x, b.distance, b.along_x, t),
                                   hermite(a.along_y, a.mixed, b.along_y, b.mixed, t), true};
    }
    nodes_.back() = nodes_.front();
    find_slopes();
}

/// The derivative of a cubic lies between the coefficients of its Bernstein form.
void WallLine::find_slopes() {
    for (std::size_t i = 0; i < parts; ++i) {
        const Node &a = nodes_[i], &b = nodes_[i + 1];
        const double middle = 3 * (b.distance - a.distance) - a.slope - b.slope;
        const double least = std::min({a.slope, middle, b.slope}),
                     most = std::max({a.slope, middle, b.slope});
        slopes_[i] = !a.known || !b.known ? 0 : least > 0 ? least : std::min(most, 0.0);
    }
}

/// Where a node is not known: `least` is a lower bound of the distance; `turns` is within [0, 1].
double WallLine::untabulated(double turns, double half, double least) const {
    if (half < least) return least - half;
    const SineCosine turn = sine_cosine(turns * (2 * pi));
    return plane_->wall().bound(tpms_point_on(axis_, turn, across_, plane_->z()), half);
}

double WallLine::bound(double turns, double half) const {
    const double turn = turns - std::floor(turns), place = turn * parts;
    const auto i = std::min(static_cast<std::size_t>(place), std::size_t{parts - 1});
    const Node &a = nodes_[i], &b = nodes_[i + 1];
    const double t = place - static_cast<double>(i);
    if (!a.known || !b.known)
        return untabulated(turn, half, least_between(std::abs(a.distance), std::abs(b.distance), t));
    return std::abs(hermite(a.distance, a.slope, b.distance, b.slope, t)) - half;
}

bool WallLine::is_monotone(double from, double to, double change) const {
    if (to - from >= 1) return false;
    const double first = std::floor(from * parts), last = std::floor(to * parts);
    auto i = static_cast<std::size_t>(first - std::floor(first / parts) * parts);
    const double least = change * WallPlane::step;
    const bool rises = slopes_[i] > 0;
    const bool outside = nodes_[i].distance > 0;
    for (double piece = first; piece <= last; ++piece, i = i + 1 < parts ? i + 1 : 0) {
        if (!(rises ? slopes_[i] > least : slopes_[i] < -least)) return false;
        // The distance turns where the line crosses the surface.
        if ((nodes_[i + 1].distance > 0) != outside) return false;
    }
    return true;
}

double WallLine::bound_at(std::size_t node, double half) const {
    const Node& at = nodes_[node];
    return at.known ? std::abs(at.distance) - half
                    : untabulated(static_cast<double>(node) / parts, half, at.distance);
}

void WallLine::find_runs(double half, std::vector<Interval>& out) const {
    out.clear();
    const double first = bound_at(0, half);
    std::vector<double> ends;
    double last = first;
    for (std::size_t i = 0; i < parts; ++i) {
        const double next = i + 1 < parts ? bound_at(i + 1, half) : first;
        const auto begin = static_cast<double>(i), end = begin + 1;
        // A piece that rises or falls, on one side of the surface, has one crossing at most.
        const bool one = slopes_[i] != 0 && (nodes_[i].distance > 0) == (nodes_[i + 1].distance > 0);
        find_crossings({begin / parts, end / parts}, {last, next}, half, one ? 0 : halvings, ends);
        last = next;
    }
    const bool inside = first < 0;
    if (ends.empty()) {
        if (inside) out.push_back({-infinity, infinity});
        return;
    }
    // The interval that holds turn 0 began in the period before.
    if (inside) out.push_back({ends.back() - 1, ends.front()});
    for (std::size_t i = inside ? 1 : 0; i + 1 < ends.size(); i += 2) out.push_back({ends[i], ends[i + 1]});
}

void WallLine::find_crossings(Interval turns, Interval values, double half, int depth,
                              std::vector<double>& crossings) const {
    const bool same = (values.lo < 0) == (values.hi < 0);
    if (same && std::abs(values.lo) + std::abs(values.hi) >= turns.width() * (2 * pi)) return;
    if (depth == 0) {
        if (!same) crossings.push_back(crossing(turns, values, half));
        return;
    }
    const double middle = (turns.lo + turns.hi) / 2, value = bound(middle, half);
    find_crossings({turns.lo, middle}, {values.lo, value}, half, depth - 1, crossings);
    find_crossings({middle, turns.hi}, {value, values.hi}, half, depth - 1, crossings);
}

/// The Illinois variant of the method of false position.
double WallLine::crossing(Interval turns, Interval values, double half) const {
    int kept = 0;  // which end stayed at the last step: -1 the lower, 1 the upper
    while (turns.width() > end_tolerance) {
        double at = turns.lo + turns.width() * (values.lo / (values.lo - values.hi));
        if (!(turns.lo < at && at < turns.hi)) at = (turns.lo + turns.hi) / 2;
        const double value = bound(at, half);
        if (std::abs(value) < end_tolerance) return at;
        if ((value < 0) == (values.lo < 0)) {
            turns.lo = at;
            values.lo = value;
            if (kept == 1) values.hi /= 2;
            kept = 1;
        } else {
            turns.hi = at;
            values.hi = value;
            if (kept == -1) values.lo /= 2;
            kept = -1;
        }
    }
    return (turns.lo + turns.hi) / 2;
}

}  // namespace lamella
