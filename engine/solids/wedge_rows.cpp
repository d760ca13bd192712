// Prepares wedges for the row kernel.
#include "engine/solids/wedge_rows.h"

namespace lamella {
namespace {

Interval extent(const Wedge& wedge, int axis) {
    Interval all;
    for (const dvec3& corner : wedge.corners) {
        all = {std::min(all.lo, corner[axis]), std::max(all.hi, corner[axis])};
    }
    return all;
}

/// Returns the bounding rectangle of the wedge's section: the hull of the points where its edges cross the
/// plane.
Rect section(const Wedge& wedge, double z) {
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
    return rect;
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
        if (!heights.contains(z)) continue;
        const Rect rect = section(w, z);
        if (rect.empty()) continue;
        wedges_.push_back(w);
        sections.push_back(rect);
    }
    sections_ = PlaneIndex(std::move(sections));
}

WedgeRows::WedgeRows(const std::vector<RoundTriangle>& triangles, double z)
    : WedgeRows(wedges_of(triangles), z) {}

void WedgeRows::collect(const RowBand& band, const LineRange& lines, RunCollector& runs) const {
    sections_.visit(band, lines, [&](std::uint32_t i, const LineRange& met) {
        collect_wedge(wedges_[i], band, met, runs);
    });
}

void WedgeRows::collect_wedge(const Wedge& wedge, const RowBand& band, const LineRange& lines,
                              RunCollector& runs) const {
    const int along_axis = band.axis == Axis::x ? 0 : 1, across_axis = 1 - along_axis;
    const double dz = z_ - wedge.origin.z;
    PrismInPlane p;
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
