// Union-find over the samples of all bricks; those on the faces of bricks are there several times.
#include "procedural/pattern/brick_crumbs.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <unordered_map>
#include <vector>

#include "engine/base/disjoint_sets.h"
#include "engine/base/parallel.h"

namespace lamella {

namespace {

constexpr int side = PatternBrick::side, cells = PatternBrick::cells;
constexpr auto samples = static_cast<std::size_t>(PatternBrick::samples);

glm::ivec3 place_of(std::size_t sample) {
    const auto k = static_cast<int>(sample);
    return {k % side, k / side % side, k / side / side};
}

std::size_t sample_at(glm::ivec3 at) {
    const int sample = at.x + side * (at.y + side * at.z);
    return static_cast<std::size_t>(sample);
}

/// Flags the solid samples between the surface and the depth, with a sample to spare.
std::vector<std::uint8_t> solid_samples(const Field& body, double depth, const SurfaceBricks& bricks) {
    std::vector<std::uint8_t> solid(bricks.bricks.size() * samples, 0);
    const double margin = bricks.spacing;
    parallel_for(bricks.bricks.size(), [&](std::size_t i) {
        const PatternBrick& brick = bricks.bricks[i];
        const dvec3 corner = dvec3(std::int64_t{cells} * brick.corner);
        for (std::size_t k = 0; k < samples; ++k) {
            if (brick.steps[k] <= 0) continue;  // among them no_sample
            const double value = body.value((corner + dvec3(place_of(k))) * bricks.spacing);
            solid[i * samples + k] = value <= margin && value >= -depth - margin ? 1 : 0;
        }
    });
    return solid;
}

/// Joins the solid samples of each brick, and the copies of those on its upper faces.
DisjointSets joined(const SurfaceBricks& bricks, const std::vector<std::uint8_t>& solid) {
    std::unordered_map<glm::i64vec3, std::size_t, LatticeHash> number;
    for (std::size_t i = 0; i < bricks.bricks.size(); ++i) number.emplace(bricks.bricks[i].corner, i);
    DisjointSets sets(solid.size());
    const auto join = [&](std::size_t a, std::size_t b) {
        if (solid[b] != 0) sets.join(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b));
    };
    for (std::size_t i = 0; i < bricks.bricks.size(); ++i) {
        for (std::size_t k = 0; k < samples; ++k) {
            const std::size_t here = i * samples + k;
            if (solid[here] == 0) continue;
            const glm::ivec3 at = place_of(k), over = at / cells;
            for (int axis = 0; axis < 3; ++axis) {
                glm::ivec3 next = at;
                if (++next[axis] < side) join(here, i * samples + sample_at(next));
            }
            if (over == glm::ivec3(0)) continue;
            const auto other = number.find(bricks.bricks[i].corner + glm::i64vec3(over));
            if (other != number.end()) join(here, other->second * samples + sample_at(at - cells * over));
        }
    }
    return sets;
}

}  // namespace

std::size_t drop_crumbs(const Field& body, double depth, std::size_t least, SurfaceBricks& bricks) {
    const std::vector<std::uint8_t> solid = solid_samples(body, depth, bricks);
    DisjointSets sets = joined(bricks, solid);
    std::vector<std::uint32_t> sizes(solid.size(), 0);
    for (std::size_t i = 0; i < solid.size(); ++i) {
        if (solid[i] != 0) ++sizes[sets.find(static_cast<std::uint32_t>(i))];
    }
    std::size_t dropped = 0;
    for (std::size_t i = 0; i < solid.size(); ++i) dropped += sizes[i] > 0 && sizes[i] < least ? 1 : 0;
    for (std::size_t i = 0; i < solid.size() && dropped > 0; ++i) {
        if (solid[i] == 0 || sizes[sets.find(static_cast<std::uint32_t>(i))] >= least) continue;
        std::int16_t& step = bricks.bricks[i / samples].steps[i % samples];
        step = static_cast<std::int16_t>(-step);
    }
    return dropped;
}

}  // namespace lamella
