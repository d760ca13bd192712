// The edges of a Voronoi diagram by brute force: every triple's line of equal distance, clipped by every
// other seed's bisector.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "procedural/voronoi/seed_tree.h"

namespace lamella {

using VoronoiEdge = std::pair<dvec3, dvec3>;

/// Edges of positive length whose three seeds are `inner`, clipped by all of `seeds`. Unbounded ones are left
/// out.
inline std::vector<VoronoiEdge> brute_voronoi_edges(const std::vector<Seed>& seeds,
                                                    const std::vector<dvec3>& inner, dvec3 middle) {
    std::vector<dvec3> all;
    for (const Seed& seed : seeds) all.push_back(seed.position);
    // The order does not change the result; seeds near the middle end most intervals soonest.
    std::sort(all.begin(), all.end(),
              [&](dvec3 a, dvec3 b) { return glm::distance(a, middle) < glm::distance(b, middle); });
    std::vector<VoronoiEdge> edges;
    for (std::size_t i = 0; i < inner.size(); ++i) {
        for (std::size_t j = i + 1; j < inner.size(); ++j) {
            for (std::size_t k = j + 1; k < inner.size(); ++k) {
                const dvec3 a = inner[i], u = inner[j] - a, v = inner[k] - a, normal = glm::cross(u, v);
                const double square = glm::dot(normal, normal);
                if (square == 0) continue;
                const dvec3 direction = normal / std::sqrt(square);
                const dvec3 center =
                    glm::cross(glm::dot(u, u) * v - glm::dot(v, v) * u, normal) / (2 * square);
                double lo = -infinity, hi = infinity;
                for (const dvec3 other : all) {
                    const dvec3 w = other - a;
                    if (w == dvec3(0.0) || w == u || w == v) continue;
                    const double slope = glm::dot(direction, w);
                    const double room = 0.5 * glm::dot(w, w) - glm::dot(center, w);
                    if (slope > 1e-14) {
                        hi = std::min(hi, room / slope);
                    } else if (slope < -1e-14) {
                        lo = std::max(lo, room / slope);
                    } else if (room < -1e-12) {
                        lo = infinity;
                    }
                    if (hi - lo < 1e-10) break;
                }
                if (hi - lo < 1e-10 || hi == infinity || lo == -infinity) continue;
                edges.push_back({a + center + lo * direction, a + center + hi * direction});
            }
        }
    }
    return edges;
}

/// The same for the seeds in a box.
inline std::vector<VoronoiEdge> brute_voronoi_edges(const std::vector<Seed>& seeds, const Box& core) {
    std::vector<dvec3> inner;
    for (const Seed& seed : seeds) {
        if (core.contains(seed.position)) inner.push_back(seed.position);
    }
    return brute_voronoi_edges(seeds, inner, core.center());
}

}  // namespace lamella
