// Prepares wedges for the row kernel.
#include "engine/solids/wedge_rows.h"

#include <algorithm>
#include <cmath>

namespace lamella {
namespace {

/// Returns how far outside of its edges the sides of a wedge are put, mm, so that a line along the edge that
/// two triangles share is in both of their wedges whatever rounding does: single precision knows a side
/// to 2.4e-7 of the triangle's size. There the wedge leaves the round triangle by slack^2 / 2 radii at most,
/// since a side is normal to the surface of the balls about its edge.
double side_slack(const Wedge& wedge) {
    constexpr double min_slack = 1e-7, share = 1e-6;
    double square = 0;
    for (const dvec3& corner : wedge.corners) {
        const dvec3 off = corner - wedge.origin;
        square = std::max(square, glm::dot(off, off));
    }
    return std::max(min_slack, share * std::sqrt(square));
}

Interval extent(const Wedge& wedge, int axis) {
    Interval all;
    for (const dvec3& corner : wedge.corners) {
        all = {std::min(all.lo, corner[axis]), std::max(all.hi, corner[axis])};
    }
    return all;
}

/// Returns the bounding rectangle of the wedge's section: the hull of the points where its edges cross the
/// plane, or come nearest to it, and the slack.
Rect section(const Wedge& wedge, const Interval& heights, double slack, double plane) {
    const double z = std::clamp(plane, heights.lo, heights.hi);
    Rect rect;
    const auto add = [&](dvec2 p) { rect = unite(rect, {p, p}); };
    const auto cross = [&](std::size_t i, std::size_t j) {
        const dvec3 a = wedge.corners[i], b = wedge.corners[j];
        if (a.z == z) add(dvec2(a));
        if (b.z == z) add(dvec2(b));
        if ((a.z < z) == (b.z < z)) return;
        add(dvec2(a) + (dvec2(b) - dvec2(a)) * ((z - a.z) / (b.z - a.z)));
    };
    for (std::size_t i = 0; i < 3; ++i) {
        cross(i, (i + 1) % 3);
        cross(3 + i, 3 + (i + 1) % 3);
        cross(i, 3 + i);
    }
    return {rect.lo - slack, rect.hi + slack};
}

std::vector<Wedge> wedges_of(const std::vector<RoundTriangle>& triangles) {
    std::vector<Wedge> wedges;
    wedges.reserve(triangles.size());
    for (const RoundTriangle& triangle : triangles) {
        if (const auto w = wedge(triangle)) wedges.push_back(*w);
    }
    return wedges;
}

}  // namespace

WedgeRows::WedgeRows(const std::vector<Wedge>& wedges, double z) : z_(z) {
    std::vector<Rect> sections;
    for (const Wedge& w : wedges) {
        const Interval heights = extent(w, 2);
        const double slack = side_slack(w);
        if (z < heights.lo - slack || z > heights.hi + slack) continue;
        const Rect rect = section(w, heights, slack, z);
        wedges_.push_back(w);
        for (std::size_t side = 2; side < w.limits.size(); ++side) wedges_.back().limits[side] += slack;
        sections.push_back(rect);
    }
    sections_ = PlaneIndex(std::move(sections));
}

WedgeRows::WedgeRows(const std::vector<RoundTriangle>& triangles, double z)
    : WedgeRows(wedges_of(triangles), z) {}

void WedgeRows::collect(const RowBand& band, const LineRange& lines, RunCollector& runs) const {
    sections_.visit(band, lines,
                    [&](std::uint32_t i, const LineRange& met) { collect_wedge(i, band, met, runs); });
}

void WedgeRows::collect_wedge(std::uint32_t number, const RowBand& band, const LineRange& lines,
                              RunCollector& runs) const {
    const Wedge& wedge = wedges_[number];
    const int along_axis = band.axis == Axis::x ? 0 : 1, across_axis = 1 - along_axis;
    const double dz = z_ - wedge.origin.z;
    PrismInPlane p;
    // Beyond a sharp corner the slack of two sides adds up to many times its width; the rectangle ends it.
    const Rect& rect = sections_.rect(number);
    p.low = static_cast<float>(rect.lo[along_axis] - wedge.origin[along_axis]);
    p.high = static_cast<float>(rect.hi[along_axis] - wedge.origin[along_axis]);
    for (std::size_t k = 0; k < wedge.normals.size(); ++k) {
        const dvec3 normal = wedge.normals[k];
        p.nx[k] = static_cast<float>(normal[along_axis]);
        p.ny[k] = static_cast<float>(normal[across_axis]);
        p.limit[k] = static_cast<float>(wedge.limits[k] - normal.z * dz);
    }
    const int count = lines.last - lines.first;
    const auto out = runs.add(lines.first, count);
    prism_rows(line_frame(band, lines.first, dvec2(wedge.origin)), p, count, out.begin, out.end);
}

}  // namespace lamella
