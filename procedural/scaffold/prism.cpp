// Signed distances and line intersections of prisms.
#include "procedural/scaffold/prism.h"

namespace lamella {
namespace {

/// Returns the part of a line with |p . axis| <= half. The line is (t, across) for lines along x, (across, t)
/// for lines along y.
Interval slab(Axis lines, dvec2 axis, double half, double across) {
    const double along_part = lines == Axis::x ? axis.x : axis.y;
    const double offset = across * (lines == Axis::x ? axis.y : axis.x);
    if (along_part == 0) return -half <= offset && offset < half ? Interval{-infinity, infinity} : Interval{};
    const double p = (-half - offset) / along_part, q = (half - offset) / along_part;
    return {std::min(p, q), std::max(p, q)};
}

/// Returns the intersection with the line at `across`; both are relative to the prism's centre.
Interval cut(const Prism& upright, Axis lines, double across) {
    if (upright.round) {
        const double h = upright.half.x * upright.half.x - across * across;
        if (!(h > 0)) return {};
        return {-std::sqrt(h), std::sqrt(h)};
    }
    const dvec2 u = upright.direction, v(-u.y, u.x);
    const Interval a = slab(lines, u, upright.half.x, across), b = slab(lines, v, upright.half.y, across);
    if (a.empty() || b.empty()) return {};
    return {std::max(a.lo, b.lo), std::min(a.hi, b.hi)};
}

}  // namespace

double signed_distance(const Prism& upright, dvec3 p) {
    const dvec2 d = dvec2(p) - upright.center;
    const double z = std::max(upright.lo - p.z, p.z - upright.hi);
    if (upright.round) {
        const double r = std::sqrt(glm::dot(d, d)) - upright.half.x;
        const dvec2 out = glm::max(dvec2(r, z), dvec2(0.0));
        return std::min(std::max(r, z), 0.0) + std::sqrt(glm::dot(out, out));
    }
    const dvec2 u = upright.direction, v(-u.y, u.x);
    const dvec3 q(std::abs(glm::dot(d, u)) - upright.half.x, std::abs(glm::dot(d, v)) - upright.half.y, z);
    const dvec3 out = glm::max(q, dvec3(0.0));
    return std::min(std::max(q.x, std::max(q.y, q.z)), 0.0) + std::sqrt(glm::dot(out, out));
}

Box bounds(const Prism& upright) {
    dvec2 reach = upright.half;
    if (!upright.round) {
        const dvec2 u = glm::abs(upright.direction);
        reach = {u.x * upright.half.x + u.y * upright.half.y, u.y * upright.half.x + u.x * upright.half.y};
    }
    return {dvec3(upright.center - reach, upright.lo), dvec3(upright.center + reach, upright.hi)};
}

UprightRows::UprightRows(const std::vector<Prism>& uprights) : uprights_(uprights) {
    std::vector<Rect> rects;
    for (const Prism& upright : uprights_) rects.push_back(lamella::bounds(upright).rect());
    sections_ = PlaneIndex(std::move(rects));
}

void UprightRows::collect(const RowBand& band, RunCollector& runs) const {
    sections_.visit(band, {0, band.lines()}, [&](std::uint32_t i, const LineRange& lines) {
        const Prism& upright = uprights_[i];
        const int along_axis = band.axis == Axis::x ? 0 : 1;
        const double along = upright.center[along_axis], across = upright.center[1 - along_axis];
        const auto out = runs.add(lines.first, lines.last - lines.first);
        for (int l = lines.first; l < lines.last; ++l) {
            const Interval solid = cut(upright, band.axis, band.line(l) - across);
            std::int32_t& begin = out.begin[l - lines.first];
            std::int32_t& end = out.end[l - lines.first];
            begin = end = 0;
            if (solid.empty()) continue;
            const double p = band.coordinate(along + solid.lo), q = band.coordinate(along + solid.hi);
            begin = round_run(std::min(p, q));
            end = round_run(std::max(p, q));
        }
    });
}

}  // namespace lamella
