// Union-find over the samples of all bricks; those on the faces of bricks are there several times.
#include "procedural/pattern/brick_crumbs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
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

constexpr float nowhere = std::numeric_limits<float>::infinity();

/// Returns how far each sample is outside the skin, mm: 0 within it, nowhere for those farther than the
/// diagonal of a cell.
std::vector<float> distances_outside(const Field& body, double depth, const SurfaceBricks& bricks) {
    std::vector<float> outside(bricks.bricks.size() * samples, nowhere);
    const double diagonal = std::sqrt(3.0) * bricks.spacing;
    parallel_for(bricks.bricks.size(), [&](std::size_t i) {
        const PatternBrick& brick = bricks.bricks[i];
        const dvec3 corner = dvec3(std::int64_t{cells} * brick.corner);
        for (std::size_t k = 0; k < samples; ++k) {
            if (brick.steps[k] == PatternBrick::no_sample) continue;
            const double value = body.value((corner + dvec3(place_of(k))) * bricks.spacing);
            const double far = std::max({value, -depth - value, 0.0});
            if (far <= diagonal) outside[i * samples + k] = static_cast<float>(far);
        }
    });
    return outside;
}

/// Joins the copies of each sample on the faces of bricks.
DisjointSets joined_copies(const SurfaceBricks& bricks) {
    std::unordered_map<glm::i64vec3, std::size_t, LatticeHash> number;
    for (std::size_t i = 0; i < bricks.bricks.size(); ++i) number.emplace(bricks.bricks[i].corner, i);
    DisjointSets sets(bricks.bricks.size() * samples);
    for (std::size_t i = 0; i < bricks.bricks.size(); ++i) {
        for (std::size_t k = 0; k < samples; ++k) {
            const glm::ivec3 at = place_of(k), over = at / cells;
            if (over == glm::ivec3(0)) continue;
            for (int axes = 1; axes < 8; ++axes) {
                const glm::ivec3 toward(axes & 1, axes >> 1 & 1, axes >> 2);
                if (glm::min(toward, over) != toward) continue;
                const auto other = number.find(bricks.bricks[i].corner + glm::i64vec3(toward));
                if (other == number.end()) continue;
                sets.join(
                    static_cast<std::uint32_t>(i * samples + k),
                    static_cast<std::uint32_t>(other->second * samples + sample_at(at - cells * toward)));
            }
        }
    }
    return sets;
}

/// Calls visit(a, b) for all neighbours a and b of a brick, b after a along an axis.
template <typename Visit>
void for_neighbours(std::size_t brick, const Visit& visit) {
    for (std::size_t k = 0; k < samples; ++k) {
        const glm::ivec3 at = place_of(k);
        for (int axis = 0; axis < 3; ++axis) {
            glm::ivec3 next = at;
            if (++next[axis] < side) visit(brick * samples + k, brick * samples + sample_at(next));
        }
    }
}

struct KeptSamples {
    std::vector<std::uint8_t> flags;  ///< by representative
    std::size_t dropped = 0;          ///< pieces
};

/// What the samples of bricks are.
struct Samples {
    std::vector<std::uint8_t> solid;
    std::vector<float> outside;
    DisjointSets copies;

    std::size_t size() const { return solid.size(); }
    std::size_t bricks() const { return solid.size() / samples; }
    bool is_part(std::size_t i) const { return solid[i] != 0 && outside[i] <= 0; }
    std::uint32_t representative(std::size_t i) { return copies.find(static_cast<std::uint32_t>(i)); }
};

/// Keeps the pieces within the skin that have at least `least` samples.
KeptSamples kept_samples(Samples& all, std::size_t least) {
    DisjointSets pieces = all.copies;
    const auto piece = [&](std::size_t i) { return pieces.find(static_cast<std::uint32_t>(i)); };
    for (std::size_t brick = 0; brick < all.bricks(); ++brick) {
        for_neighbours(brick, [&](std::size_t a, std::size_t b) {
            if (all.is_part(a) && all.is_part(b)) pieces.join(piece(a), piece(b));
        });
    }
    std::vector<std::uint32_t> sizes(all.size(), 0);
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (all.is_part(i) && all.representative(i) == i) ++sizes[piece(i)];
    }
    KeptSamples kept{std::vector<std::uint8_t>(all.size(), 0)};
    for (std::size_t i = 0; i < all.size(); ++i) {
        kept.dropped += sizes[i] > 0 && sizes[i] < least ? 1 : 0;
        if (all.is_part(i) && sizes[piece(i)] >= least) kept.flags[all.representative(i)] = 1;
    }
    return kept;
}

/// Keeps the solid samples outside the skin whose neighbour nearest to it is kept, for as many steps as are
/// between the corners of a cell.
void keep_outside(Samples& all, std::vector<std::uint8_t>& kept) {
    constexpr std::uint32_t none = 0xffffffff;
    std::vector<std::uint32_t> nearest(all.size(), none);
    const auto offer = [&](std::size_t sample, std::size_t neighbour) {
        if (!(all.outside[neighbour] < all.outside[sample]) || all.outside[sample] == nowhere) return;
        std::uint32_t& best = nearest[all.representative(sample)];
        if (best == none || all.outside[neighbour] < all.outside[best]) best = all.representative(neighbour);
    };
    for (std::size_t brick = 0; brick < all.bricks(); ++brick) {
        for_neighbours(brick, [&](std::size_t a, std::size_t b) {
            offer(a, b);
            offer(b, a);
        });
    }
    constexpr int corner_steps = 3;
    for (int step = 0; step < corner_steps; ++step) {
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (all.solid[i] != 0 && nearest[i] != none && kept[nearest[i]] != 0) kept[i] = 1;
        }
    }
}

}  // namespace

std::size_t drop_crumbs(const Field& body, double depth, std::size_t least, SurfaceBricks& bricks) {
    Samples all{std::vector<std::uint8_t>(bricks.bricks.size() * samples),
                distances_outside(body, depth, bricks), joined_copies(bricks)};
    for (std::size_t i = 0; i < all.size(); ++i)
        all.solid[i] = bricks.bricks[i / samples].steps[i % samples] > 0 ? 1 : 0;
    KeptSamples kept = kept_samples(all, least);
    keep_outside(all, kept.flags);
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (all.solid[i] != 0 && all.outside[i] < nowhere && kept.flags[all.representative(i)] == 0)
            bricks.bricks[i / samples].steps[i % samples] = -1;
    }
    return kept.dropped;
}

}  // namespace lamella
