// A picture of polygons by its own rule, for tests to count pieces in: even-odd at pixel centres, flood fill.
#pragma once

#include <vector>

#include "engine/base/geometry.h"

namespace lamella::test {

using Ring = std::vector<dvec2>;

/// Whether a point lies inside rings, by the even-odd rule.
inline bool inside_rings(const std::vector<Ring>& rings, dvec2 p) {
    bool inside = false;
    for (const Ring& ring : rings) {
        for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
            const dvec2 a = ring[i], b = ring[j];
            if ((a.y > p.y) == (b.y > p.y)) continue;
            if (p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
        }
    }
    return inside;
}

/// Number of connected pieces (by the four sides of pixels) of the rings' inside.
inline int count_raster_pieces(const std::vector<Ring>& rings, double pixel) {
    Rect box;
    for (const Ring& ring : rings) {
        for (const dvec2& p : ring) box = unite(box, Rect{p, p});
    }
    if (box.empty()) return 0;
    const int nx = static_cast<int>(box.size().x / pixel) + 3,
              ny = static_cast<int>(box.size().y / pixel) + 3;
    std::vector<char> solid(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny), 0);
    const auto at = [&](int x, int y) -> char& {
        return solid[static_cast<std::size_t>(y) * static_cast<std::size_t>(nx) +
                     static_cast<std::size_t>(x)];
    };
    for (int y = 1; y + 1 < ny; ++y) {
        for (int x = 1; x + 1 < nx; ++x)
            at(x, y) = inside_rings(rings, box.lo + dvec2(x - 0.5, y - 0.5) * pixel) ? 1 : 0;
    }
    int pieces = 0;
    std::vector<std::pair<int, int>> open;
    for (int y = 1; y + 1 < ny; ++y) {
        for (int x = 1; x + 1 < nx; ++x) {
            if (at(x, y) == 0) continue;
            ++pieces;
            open.emplace_back(x, y);
            while (!open.empty()) {
                const auto [i, j] = open.back();
                open.pop_back();
                if (at(i, j) == 0) continue;
                at(i, j) = 0;
                for (const auto& [di, dj] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}})
                    open.emplace_back(i + di, j + dj);
            }
        }
    }
    return pieces;
}

}  // namespace lamella::test
