// Scanline crossings: a side crosses a line if one end is at or below the line and the other one above it.
#include "engine/solids/polygon_slice.h"

#include <algorithm>
#include <cmath>

#include "engine/solids/closed_slice.h"

namespace lamella {

PolygonSlice::PolygonSlice(std::span<const std::vector<dvec2>> polygons) {
    for (const std::vector<dvec2>& polygon : polygons) {
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const dvec2 a = polygon[i], b = polygon[i + 1 < polygon.size() ? i + 1 : 0];
            bounds_ = {glm::min(bounds_.lo, a), glm::max(bounds_.hi, a)};
            if (a != b) sides_.push_back({a, b});
        }
    }
}

void PolygonSlice::runs(const RowBand& band, Scratch& /*scratch*/, RunRows& out) const {
    out.clear();
    if (band.lines() == 0) return;
    const int along = band.axis == Axis::x ? 0 : 1, across = 1 - along;
    std::vector<std::vector<double>> crossings(static_cast<std::size_t>(band.lines()));
    const double first = band.line(0), step = band.line_pitch();
    for (const Side& side : sides_) {
        const double low = std::min(side.a[across], side.b[across]),
                     high = std::max(side.a[across], side.b[across]);
        // One more line at both ends: the lines' own positions decide which of them are crossed.
        const double from = (low - first) / step, to = (high - first) / step;
        const double last = band.lines() - 1;
        if (std::max(from, to) < -1 || std::min(from, to) > last + 1) continue;
        const int begin = static_cast<int>(std::clamp(std::floor(std::min(from, to)) - 1, 0.0, last));
        const int end = static_cast<int>(std::clamp(std::ceil(std::max(from, to)) + 1, 0.0, last));
        for (int l = begin; l <= end; ++l) {
            const double c = band.line(l);
            if (!(low <= c && c < high)) continue;
            const double share = (c - side.a[across]) / (side.b[across] - side.a[across]);
            crossings[static_cast<std::size_t>(l)].push_back(side.a[along] +
                                                             share * (side.b[along] - side.a[along]));
        }
    }
    std::vector<Interval> inside;
    for (std::vector<double>& line : crossings) {
        std::sort(line.begin(), line.end());
        inside.clear();
        for (std::size_t i = 0; i + 1 < line.size(); i += 2) inside.push_back({line[i], line[i + 1]});
        push_intervals(band, inside, out);
    }
}

double PolygonSlice::value(dvec2 p) const {
    double nearest = infinity;
    bool inside = false;
    for (const Side& side : sides_) {
        const dvec2 along = side.b - side.a;
        const double share = std::clamp(glm::dot(p - side.a, along) / glm::dot(along, along), 0.0, 1.0);
        nearest = std::min(nearest, glm::distance(p, side.a + share * along));
        if ((side.a.y <= p.y) != (side.b.y <= p.y) && p.x < side.a.x + (p.y - side.a.y) / along.y * along.x)
            inside = !inside;
    }
    return inside ? -nearest : nearest;
}

Interval PolygonSlice::range(const Rect& r) const {
    const double v = value(r.center()), reach = glm::length(r.size()) / 2;
    return {v - reach, v + reach};
}

void PolygonSlice::sample(const Tile& tile, std::span<float> out) const {
    std::size_t at = 0;
    for (int j = 0; j < tile.ny; ++j) {
        for (int i = 0; i < tile.nx; ++i)
            out[at++] = static_cast<float>(value(tile.origin + dvec2(i, j) * tile.step));
    }
}

}  // namespace lamella
