// Builds a coarse cell's octree: distributes counts downwards and jitters seeds in the leaves.
#include "procedural/voronoi/seed_tree.h"

#include <array>
#include <cmath>
#include <string>

#include "engine/base/error.h"

namespace lamella {
namespace {

constexpr int coarse_bits = 38;    // log2 of the integer positions per coarse side
constexpr int fraction_bits = 21;  // random bits per axis within an octant of a leaf
constexpr int deepest_level = 15;  // octants of its leaves have 22 bits: 21 random ones and the half step
constexpr double leaf_seeds = 8;   // maximum expected seeds of a leaf: one per octant
constexpr double seeds_of_bcc_leaf = 2;
// geometric mean of the 2 seeds of a leaf and the 16 of its children
constexpr double bcc_leaf_seeds = 5.656854249492381;
constexpr double share_rounding =
    1 + 1e-9;  // an expected count of exactly eight must not split because of a rounding error
constexpr std::size_t max_nodes = std::size_t{1} << 22;
constexpr std::int64_t index_limit = std::int64_t{1} << 24;
constexpr std::size_t block_cache_bytes = std::size_t{256} << 20;
constexpr std::size_t idle_block_bytes = std::size_t{1} << 19;

enum Draw : std::uint64_t { draw_count, draw_order, draw_offset, draw_first_seed };

using Order = std::array<std::uint8_t, 8>;

/// Returns a uniformly random order of the eight octants (Fisher-Yates; the bias of 56 bits modulo 8! is
/// below 1e-12).
Order random_order(std::uint64_t bits) {
    Order order = {0, 1, 2, 3, 4, 5, 6, 7};
    for (std::size_t i = 7; i > 0; --i) {
        std::swap(order[i], order[static_cast<std::size_t>(bits % (i + 1))]);
        bits /= i + 1;
    }
    return order;
}

glm::i64vec3 octant_corner(glm::i64vec3 corner, int level, unsigned octant) {
    const std::int64_t half = std::int64_t{1} << (coarse_bits - level - 1);
    return corner + half * glm::i64vec3(octant & 1, (octant >> 1) & 1, (octant >> 2) & 1);
}

}  // namespace

SeedKey SeedBlock::key(std::uint32_t seed) const {
    constexpr std::int64_t bias = std::int64_t{1} << 31;
    const auto biased = [](std::int64_t v) { return static_cast<std::uint64_t>(v + bias); };
    return {biased(index.z) << 32 | biased(index.y), biased(index.x) << 32 | seed};
}

std::size_t SeedBlock::bytes() const {
    return sizeof(SeedBlock) + nodes.capacity() * sizeof(SeedNode) + positions.capacity() * sizeof(dvec3);
}

/// A block under construction.
struct SeedTree::Growth {
    SeedBlock block;
    std::vector<double> integrals;  ///< of the density, by node
    double step;                    ///< mm per integer position
    int lowest_leaf = deepest_level + 1;
    int highest_leaf = -1;
    bool crowded = false;  ///< an octant of a leaf holds two seeds

    dvec3 position(glm::i64vec3 units) const {
        const glm::i64vec3 whole = (block.index << std::int64_t{coarse_bits}) + units;
        return dvec3(whole) * step;
    }
    Box box(glm::i64vec3 corner, int level) const {
        return {position(corner), position(corner + (std::int64_t{1} << (coarse_bits - level)))};
    }
    double diagonal(int level) const {
        return std::sqrt(3.0) * step * static_cast<double>(std::int64_t{1} << (coarse_bits - level));
    }
    void cover(int level) { block.hole = std::max(block.hole, diagonal(level)); }
};

SeedTree::SeedTree(std::shared_ptr<const Density> density, double coarse_side, std::uint64_t recipe_seed,
                   SeedPattern pattern, double jitter, std::int64_t period)
    : density_(std::move(density)),
      side_(coarse_side),
      recipe_seed_(recipe_seed),
      pattern_(pattern),
      period_(period),
      blocks_(block_cache_bytes, idle_block_bytes) {
    if (!(coarse_side > 0) || !std::isfinite(coarse_side)) {
        throw InputError("the coarse cell's side is " + std::to_string(coarse_side) +
                         " mm; it must be positive and finite");
    }
    if (!(jitter >= 0 && jitter <= 1)) {
        throw InputError("the seeds' jitter is " + std::to_string(jitter) + "; it must be from 0 to 1");
    }
    if (period < 0) throw InputError("seeds cannot repeat after less than one coarse cell");
    jitter_ = static_cast<std::int64_t>(jitter * 0x1p20);
}

glm::i64vec3 SeedTree::original(glm::i64vec3 index) const {
    if (period_ == 0) return index;
    for (int axis = 0; axis < 3; ++axis) index[axis] = (index[axis] % period_ + period_) % period_;
    return index;
}

glm::i64vec3 SeedTree::block_index(dvec3 p) const {
    const dvec3 scaled = glm::floor(p / side_);
    for (int axis = 0; axis < 3; ++axis) {
        if (!(std::abs(scaled[axis]) <= static_cast<double>(index_limit))) {
            throw InputError("a foam was asked for at " + std::to_string(p[axis]) +
                             " mm; seeds reach 2^24 coarse cells of " + std::to_string(side_) +
                             " mm from the origin");
        }
    }
    return glm::i64vec3(scaled);
}

Box SeedTree::block_box(glm::i64vec3 index) const {
    return {dvec3(index) * side_, dvec3(index + std::int64_t{1}) * side_};
}

std::shared_ptr<const SeedBlock> SeedTree::block(glm::i64vec3 index) const {
    const double z = (static_cast<double>(index.z) + 0.5) * side_;
    return blocks_.find_or_make({index.x, index.y, index.z, 0, 0}, z, [&] { return make_block(index); });
}

std::vector<Seed> SeedTree::seeds_in(const Box& box) const {
    std::vector<Seed> seeds;
    if (box.empty()) return seeds;
    // A position on a coarse cell's border may round out of the cell, hence the margin of one cell.
    const glm::i64vec3 lo = block_index(box.lo) - std::int64_t{1};
    const glm::i64vec3 hi = block_index(box.hi) + std::int64_t{1};
    for (std::int64_t z = lo.z; z <= hi.z; ++z) {
        for (std::int64_t y = lo.y; y <= hi.y; ++y) {
            for (std::int64_t x = lo.x; x <= hi.x; ++x) {
                if (intersect(grown(block_box({x, y, z}), 1e-9 * side_), box).empty()) continue;
                const auto held = block({x, y, z});
                for (std::uint32_t i = 0; i < held->positions.size(); ++i) {
                    if (box.contains(held->positions[i])) seeds.push_back(held->seed(i));
                }
            }
        }
    }
    return seeds;
}

SeedBlock SeedTree::make_block(glm::i64vec3 index) const {
    Growth growth;
    growth.block.index = index;
    growth.step = side_ * 0x1p-38;
    SeedNode root;
    root.box = growth.box({0, 0, 0}, 0);
    growth.block.nodes.push_back(root);

    split(growth, 0, {0, 0, 0});
    integrate(growth);
    const double expected = growth.integrals.front();
    if (!(expected > 0)) {
        throw InputError("the density gives " + std::to_string(expected) + " seeds in a coarse cell of " +
                         std::to_string(side_) + " mm; it must give more than 0");
    }
    const glm::i64vec3 place = original(index);
    const CounterHash hash(recipe_seed_, 0, place.x, place.y, place.z);
    const auto count = static_cast<std::uint32_t>(std::floor(expected + hash.uniform(draw_count)));
    growth.block.positions.reserve(std::max(count, 1U));
    deal(growth, 0, {0, 0, 0}, std::max(count, 1U));
    if (growth.lowest_leaf == growth.highest_leaf && !growth.crowded) {
        growth.block.leaf_level = growth.lowest_leaf;
    }
    return std::move(growth.block);
}

/// Splits a node until no leaf expects more seeds than it can hold.
void SeedTree::split(Growth& growth, std::size_t node, glm::i64vec3 corner) const {
    const Box box = growth.block.nodes[node].box;
    const int level = growth.block.nodes[node].level;
    const dvec3 size = box.size();
    const double densest = density_->range(box).hi, most = is_patterned() ? bcc_leaf_seeds : leaf_seeds;
    if (densest * (size.x * size.y * size.z) <= most * share_rounding) return;
    const auto first_child = growth.block.nodes.size();
    if (level == deepest_level || first_child > max_nodes) {
        throw InputError("the density reaches " + std::to_string(densest) +
                         " seeds per mm^3, too dense for a coarse cell of " + std::to_string(side_) +
                         " mm; choose a smaller coarse cell or a lower density");
    }
    growth.block.nodes[node].first_child = static_cast<std::int32_t>(first_child);
    growth.block.nodes.resize(first_child + 8);
    for (unsigned octant = 0; octant < 8; ++octant) {
        const glm::i64vec3 at = octant_corner(corner, level, octant);
        SeedNode& child = growth.block.nodes[first_child + octant];
        child.level = level + 1;
        child.box = growth.box(at, level + 1);
        split(growth, first_child + octant, at);
    }
}

/// Integrates the density over every node: over all leaves at once, then sums upwards.
void SeedTree::integrate(Growth& growth) const {
    const std::vector<SeedNode>& nodes = growth.block.nodes;
    std::vector<std::size_t> leaves;
    std::vector<Box> boxes;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (nodes[i].first_child >= 0) continue;
        leaves.push_back(i);
        boxes.push_back(nodes[i].box);
    }
    std::vector<double> seeds(leaves.size(), seeds_of_bcc_leaf);
    if (!is_patterned()) density_->integrals(boxes, seeds);
    growth.integrals.assign(nodes.size(), 0);
    for (std::size_t i = 0; i < leaves.size(); ++i) growth.integrals[leaves[i]] = seeds[i];
    // Children follow their parents.
    for (std::size_t i = nodes.size(); i-- > 0;) {
        if (nodes[i].first_child < 0) continue;
        for (std::size_t octant = 0; octant < 8; ++octant)
            growth.integrals[i] += growth.integrals[static_cast<std::size_t>(nodes[i].first_child) + octant];
    }
}

void SeedTree::deal(Growth& growth, std::size_t node, glm::i64vec3 corner, std::uint32_t count) const {
    SeedNode& here = growth.block.nodes[node];
    const int level = here.level;
    here.first_seed = static_cast<std::uint32_t>(growth.block.positions.size());
    here.seed_count = count;
    if (count == 0) return;

    const std::int64_t position_shift = coarse_bits - level;
    const glm::i64vec3 place_at_level =
        (original(growth.block.index) << std::int64_t{level}) + (corner >> position_shift);
    const CounterHash hash(recipe_seed_, level, place_at_level.x, place_at_level.y, place_at_level.z);
    if (here.first_child < 0) {
        place(growth, hash, level, corner, count);
        return;
    }

    // Systematic sampling: lay the octants end to end in a random order; every integer plus one offset is a
    // seed. The last end is `count` by definition, so the counts add up despite rounding.
    const auto first_child = static_cast<std::size_t>(here.first_child);
    const Order order = random_order(hash.bits(draw_order));
    const double offset = hash.uniform(draw_offset), total = growth.integrals[node];
    std::array<std::uint32_t, 8> dealt;
    double end = 0;
    std::uint32_t before = 0;
    for (std::size_t i = 0; i < 8; ++i) {
        end += growth.integrals[first_child + order[i]];
        const double reached = i == 7 ? count : std::floor(count * (end / total) + offset);
        const auto upto = std::min(static_cast<std::uint32_t>(std::max(reached, 0.0)), count);
        dealt[order[i]] = upto - before;
        before = upto;
    }
    for (unsigned octant = 0; octant < 8; ++octant) {
        if (dealt[octant] == 0) growth.cover(level);
        deal(growth, first_child + octant, octant_corner(corner, level, octant), dealt[octant]);
    }
}

void SeedTree::place(Growth& growth, const CounterHash& hash, int level, glm::i64vec3 corner,
                     std::uint32_t count) const {
    constexpr std::uint64_t fraction_mask = (std::uint64_t{1} << fraction_bits) - 1;
    constexpr std::uint64_t lap_mask = 7;
    if (count > 8 * (lap_mask + 1)) throw FaultError("a leaf of the seed tree was dealt more than 64 seeds");
    growth.lowest_leaf = std::min(growth.lowest_leaf, level);
    growth.highest_leaf = std::max(growth.highest_leaf, level);
    growth.crowded = growth.crowded || count > 8;
    growth.cover(count >= 8 ? level + 1 : level);
    if (pattern_ == SeedPattern::bcc) return place_bcc(growth, hash, level, corner);

    const Order order = random_order(hash.bits(draw_order));
    const int unit_shift = coarse_bits - (level + 1) - (fraction_bits + 1);
    for (std::uint32_t i = 0; i < count; ++i) {
        std::uint64_t bits = hash.bits(draw_first_seed + i);
        // Seeds that share an octant differ in the lowest bits, so all positions are different.
        if (count > 8) bits = (bits & ~lap_mask) | (i / 8);
        const glm::i64vec3 fraction(bits & fraction_mask, (bits >> fraction_bits) & fraction_mask,
                                    (bits >> (2 * fraction_bits)) & fraction_mask);
        const glm::i64vec3 within = (fraction * std::int64_t{2} + std::int64_t{1})
                                    << std::int64_t{unit_shift};
        growth.block.positions.push_back(
            growth.position(octant_corner(corner, level, order[i % 8]) + within));
    }
}

/// Places seeds at the centres of two opposite octants, moved by less than half an octant.
void SeedTree::place_bcc(Growth& growth, const CounterHash& hash, int level, glm::i64vec3 corner) const {
    constexpr std::int64_t fraction_half = std::int64_t{1} << (fraction_bits - 1);
    constexpr std::int64_t fraction_mask = 2 * fraction_half - 1;
    const int unit_shift = coarse_bits - (level + 1) - (fraction_bits + 1);
    for (std::uint64_t i = 0; i < 2; ++i) {
        const auto bits = static_cast<std::int64_t>(hash.bits(draw_first_seed + i) >> 1);
        const auto moved = [&](int axis) {
            const std::int64_t random = ((bits >> (axis * fraction_bits)) & fraction_mask) - fraction_half;
            return (fraction_half * 2 + random * 2 * jitter_ / (std::int64_t{1} << 20)) << unit_shift;
        };
        const glm::i64vec3 within(moved(0), moved(1), moved(2));
        growth.block.positions.push_back(
            growth.position(octant_corner(corner, level, i == 0 ? 0 : 7) + within));
    }
}

}  // namespace lamella
