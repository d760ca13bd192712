// The cell of a seed among listed seeds, without a tree.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "procedural/voronoi/rounding.h"
#include "procedural/voronoi/seed_tree.h"
#include "procedural/voronoi/voronoi_cell.h"

namespace lamella::test {

/// Computes the cell of seeds[own], clipped to a cube of the given half side around it, mm. Plane identifiers
/// are indices into `seeds`. Seeds clip in order of distance, then key. Among seeds at equal positions the
/// one with the lowest key has the cell; for the others returns false and no cell.
inline bool cell_among(std::span<const Seed> seeds, std::size_t own, double half_side, VoronoiCell& cell) {
    struct Other {
        double distance_squared;
        std::size_t seed;
    };
    cell.start(half_side);
    std::vector<Other> others;
    const dvec3 center = seeds[own].position;
    for (std::size_t i = 0; i < seeds.size(); ++i) {
        if (i == own) continue;
        if (seeds[i].position == center) {
            if (seeds[i].key < seeds[own].key) return false;
            continue;
        }
        others.push_back({squared_length(seeds[i].position - center), i});
    }
    std::sort(others.begin(), others.end(), [&](const Other& a, const Other& b) {
        if (a.distance_squared != b.distance_squared) return a.distance_squared < b.distance_squared;
        return seeds[a.seed].key < seeds[b.seed].key;
    });
    for (const Other& other : others) {
        if (other.distance_squared >= 4 * cell.reach_squared() * rounding_margin) break;
        cell.clip(seeds[other.seed].position - center, static_cast<std::int32_t>(other.seed));
    }
    return true;
}

}  // namespace lamella::test
