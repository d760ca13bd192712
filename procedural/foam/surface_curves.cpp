// Subdivides triangles where the surface may pass, refines the crossings, and links them into curves.
#include "procedural/foam/surface_curves.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace lamella {
namespace {

constexpr int steps = SurfaceTracer::steps;
constexpr std::size_t points_along = steps + 1;
constexpr double narrow = 1e-3;  // share of a step
constexpr std::size_t max_edges = 20000;

/// Returns the point of an edge that is i steps from a; the same bits as seen from b.
dvec3 on_edge(dvec3 a, dvec3 b, int i) {
    return a * (static_cast<double>(steps - i) / steps) + b * (static_cast<double>(i) / steps);
}

double distance_to_segment(dvec3 p, dvec3 a, dvec3 b) {
    const dvec3 along = b - a;
    const double square = glm::dot(along, along);
    const double t = square > 0 ? std::min(std::max(glm::dot(p - a, along) / square, 0.0), 1.0) : 0.0;
    const dvec3 gap = p - (a + along * t);
    return std::sqrt(glm::dot(gap, gap));
}

void keep_between(const SurfaceCurve& curve, std::size_t first, std::size_t last, double tolerance,
                  std::vector<bool>& kept) {
    double farthest = tolerance;
    std::size_t at = first;
    for (std::size_t i = first + 1; i < last; ++i) {
        const double d = distance_to_segment(curve[i], curve[first], curve[last]);
        if (d > farthest) {
            farthest = d;
            at = i;
        }
    }
    if (at == first) return;
    kept[at] = true;
    keep_between(curve, first, at, tolerance, kept);
    keep_between(curve, at, last, tolerance, kept);
}

}  // namespace

dvec3 SurfaceTracer::crossing(dvec3 p, dvec3 q) const {
    const Field& body = *body_;
    if (PlaceOrder{}(q, p)) std::swap(p, q);
    double at_p = body.value(p), at_q = body.value(q);
    const double near = narrow * glm::distance(p, q);
    const bool inside = at_p < 0;
    double lo = 0, hi = 1;
    for (int turn = 0; hi - lo > narrow && turn < 60; ++turn) {
        // Secant steps, with a bisection every third time for curved values.
        double t = at_p / (at_p - at_q);
        if (turn % 3 == 2 || !(0 <= t && t <= 1)) t = 0.5;
        t = lo + (hi - lo) * std::min(std::max(t, 0.25 * narrow), 1 - 0.25 * narrow);
        const dvec3 middle = p + (q - p) * t;
        const double v = body.value(middle);
        if (body.metric() != Metric::sign && std::abs(v) <= near) return middle;
        if ((v < 0) == inside) {
            lo = t;
            at_p = v;
        } else {
            hi = t;
            at_q = v;
        }
    }
    return p + (q - p) * (0.5 * (lo + hi));
}

std::vector<dvec3> SurfaceTracer::inside(dvec3 a, dvec3 b) {
    // The result does not depend on which end comes first, not even in one bit.
    const bool turned = PlaceOrder{}(b, a);
    const auto [entry, fresh] = edges_.try_emplace(turned ? std::pair(b, a) : std::pair(a, b));
    if (fresh) entry->second = find_inside(entry->first.first, entry->first.second);
    std::vector<dvec3> ends = entry->second;
    if (turned) std::reverse(ends.begin(), ends.end());
    if (edges_.size() > max_edges) edges_.clear();
    return ends;
}

std::vector<dvec3> SurfaceTracer::find_inside(dvec3 a, dvec3 b) const {
    Box box;
    box.include(a);
    box.include(b);
    const Side side = side_of(box);
    if (side == Side::outside) return {};
    if (side == Side::inside) return {a, b};
    std::vector<dvec3> ends;
    dvec3 last = on_edge(a, b, 0);
    bool was_inside = holds(last);
    if (was_inside) ends.push_back(a);
    for (int i = 1; i <= steps; ++i) {
        const dvec3 p = on_edge(a, b, i);
        const bool is_inside = holds(p);
        if (is_inside != was_inside) ends.push_back(crossing(last, p));
        last = p;
        was_inside = is_inside;
    }
    if (was_inside) ends.push_back(b);
    return ends;
}

dvec3 SurfaceTracer::at(Place place) const {
    const double i = static_cast<double>(place.i) / steps, j = static_cast<double>(place.j) / steps;
    const double rest = static_cast<double>(steps - place.i - place.j) / steps;
    return triangle_[0] * rest + (triangle_[1] * i + triangle_[2] * j);
}

bool SurfaceTracer::inside(Place place) {
    std::int8_t& held =
        inside_[static_cast<std::size_t>(place.j) * points_along + static_cast<std::size_t>(place.i)];
    if (held < 0) held = holds(at(place)) ? 1 : 0;
    return held > 0;
}

/// Returns whether the surface certainly does not pass through the box.
bool SurfaceTracer::clear(const Box& box) const {
    if (body_->metric() == Metric::sign) {
        const Interval range = body_->range(box);
        return range.lo >= 0 || range.hi < 0;
    }
    return body_->clear_of_surface(box.center(), std::max(0.5 * diagonal(box) * (1 + 1e-12), sign_only));
}

SurfaceTracer::Side SurfaceTracer::side_of(const Box& box) const {
    if (!clear(box)) return Side::both;
    return holds(box.center()) ? Side::inside : Side::outside;
}

/// Divides the sub-triangle whose corner 0 is `corner`; a negative size means an inverted triangle.
void SurfaceTracer::divide(Place corner, int size) {
    const Place b{corner.i + size, corner.j}, c{corner.i, corner.j + size};
    if (std::abs(size) == 1) {
        cut(corner, b, c);
        return;
    }
    Box box;
    for (const Place place : {corner, b, c}) box.include(at(place));
    if (clear(box)) return;
    const int half = size / 2;
    divide(corner, half);
    divide({corner.i + half, corner.j}, half);
    divide({corner.i, corner.j + half}, half);
    divide({corner.i + half, corner.j + half}, -half);
}

/// Adds the segment in which the surface cuts a smallest triangle, if it does.
void SurfaceTracer::cut(Place a, Place b, Place c) {
    const std::array<Place, 3> places{a, b, c};
    std::array<bool, 3> inside{};
    for (std::size_t k = 0; k < 3; ++k) inside[k] = this->inside(places[k]);
    std::array<dvec3, 2> ends;
    std::size_t found = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t next = (k + 1) % 3;
        if (inside[k] != inside[next]) ends[found++] = crossing(at(places[k]), at(places[next]));
    }
    if (found == 2 && ends[0] != ends[1]) segments_.push_back({ends[0], ends[1]});
}

void SurfaceTracer::trace(std::span<const dvec3> ring, std::vector<SurfaceCurve>& curves) {
    Box box;
    for (const dvec3& corner : ring) box.include(corner);
    if (clear(box)) return;
    dvec3 middle(0);
    for (const dvec3& corner : ring) middle += corner / static_cast<double>(ring.size());
    segments_.clear();
    for (std::size_t i = 0; i < ring.size(); ++i) {
        triangle_[0] = middle;
        triangle_[1] = ring[i];
        triangle_[2] = ring[(i + 1) % ring.size()];
        inside_.assign(points_along * points_along, -1);
        divide({0, 0}, steps);
    }
    link(curves);
}

/// Links the segments at their common ends into curves.
void SurfaceTracer::link(std::vector<SurfaceCurve>& curves) {
    std::map<dvec3, std::vector<std::size_t>, PlaceOrder> at_end;
    for (std::size_t s = 0; s < segments_.size(); ++s) {
        at_end[segments_[s].a].push_back(s);
        at_end[segments_[s].b].push_back(s);
    }
    std::vector<bool> used(segments_.size(), false);
    const auto follow = [&](dvec3 p, SurfaceCurve& curve) {
        for (bool found = true; found;) {
            found = false;
            for (const std::size_t s : at_end[p]) {
                if (used[s]) continue;
                used[s] = found = true;
                p = segments_[s].a == p ? segments_[s].b : segments_[s].a;
                curve.push_back(p);
                break;
            }
        }
    };
    for (std::size_t s = 0; s < segments_.size(); ++s) {
        if (used[s]) continue;
        used[s] = true;
        SurfaceCurve back{segments_[s].a}, curve;
        follow(segments_[s].a, back);
        curve.assign(back.rbegin(), back.rend());
        curve.push_back(segments_[s].b);
        if (curve.front() != curve.back()) follow(segments_[s].b, curve);
        curves.push_back(std::move(curve));
    }
}

SurfaceCurve simplified(const SurfaceCurve& curve, double tolerance) {
    if (curve.size() < 3) return curve;
    std::vector<bool> kept(curve.size(), false);
    kept.front() = kept.back() = true;
    keep_between(curve, 0, curve.size() - 1, tolerance, kept);
    SurfaceCurve rest;
    for (std::size_t i = 0; i < curve.size(); ++i) {
        if (kept[i]) rest.push_back(curve[i]);
    }
    return rest;
}

}  // namespace lamella
