// The seeds of a foam: a lattice of coarse cells, each an octree whose leaves place jittered seeds.
#pragma once

#include <compare>
#include <cstdint>
#include <memory>
#include <vector>

#include "engine/base/geometry.h"
#include "procedural/voronoi/cell_cache.h"
#include "procedural/voronoi/counter_hash.h"
#include "procedural/voronoi/density.h"

namespace lamella {

/// Orders all seeds totally: the coarse cell (z, y, x), then the place in the tree's depth-first order.
/// A function of the recipe alone.
struct SeedKey {
    std::uint64_t high = 0;
    std::uint64_t low = 0;
    friend auto operator<=>(const SeedKey&,
                            const SeedKey&) = default;  // NOLINT(modernize-use-nullptr): misread by the tool
};

/// The generator point of one Voronoi cell.
struct Seed {
    dvec3 position;  ///< mm
    SeedKey key;
    friend bool operator==(const Seed&, const Seed&) = default;
};

/// A node of a coarse cell's octree. Its seeds are a range, for the seeds stand in depth-first order.
struct SeedNode {
    Box box;                        ///< mm; holds its seeds
    int level = 0;                  ///< side = coarse side / 2^level
    std::int32_t first_child = -1;  ///< the first of eight consecutive nodes, -1 for a leaf
    std::uint32_t first_seed = 0;
    std::uint32_t seed_count = 0;
};

/// How a leaf places its seeds.
enum class SeedPattern : unsigned char {
    jittered,  ///< each uniform in an octant of its own: an irregular foam
    bcc        ///< two a leaf, body-centred cubic: truncated octahedra (Kelvin's foam)
};

/// One coarse cell with its octree and seeds. Immutable once made.
struct SeedBlock {
    glm::i64vec3 index{0};
    std::vector<SeedNode> nodes;   ///< nodes[0] is the coarse cell itself
    std::vector<dvec3> positions;  ///< mm, in the order of keys
    /// The radius of no empty ball centred in this coarse cell exceeds this, mm: the longest diagonal among
    /// the smallest boxes that each hold a seed and together cover the cell.
    double hole = 0;
    /// The level of all leaves when they have one and no octant of a leaf holds two seeds; else -1.
    int leaf_level = -1;

    SeedKey key(std::uint32_t seed) const;
    Seed seed(std::uint32_t i) const { return {positions[i], key(i)}; }
    std::size_t bytes() const;
    Interval z_extent() const { return {nodes[0].box.lo.z, nodes[0].box.hi.z}; }
};

/// Seeds everywhere in space, as a pure function of (density, coarse side, recipe seed).
///
/// A node is split while the highest density in it times its volume exceeds eight; integrals are taken at the
/// leaves and summed upwards. A coarse cell's count is the floor or the ceiling of its integral (one hash
/// decides), at least one. A node's count is dealt to its octants by systematic sampling (a random order of
/// the octants, one uniform offset), so that counts add up and each differs from its share by less than one.
/// A leaf puts its seeds into different octants, each uniform in its octant: stratified jitter (Martinez,
/// Dumas, Lefebvre 2016, supplement; the dealing is ours). In the pattern bcc every leaf holds two seeds, and
/// a node is split while sqrt(32) would be wanted: sizes go by factors of two. Positions are integers of
/// 2^-38 of the coarse side, turned to double once. Thread-safe.
class SeedTree {
  public:
    /// `jitter` in [0, 1] moves the seeds of a pattern at random, by up to that share of a quarter of the
    /// leaf's side along each axis. Where `period` is above 0, seeds repeat after so many coarse cells along
    /// each axis, as far as the density does. Throws InputError unless the side is positive and finite.
    SeedTree(std::shared_ptr<const Density> density, double coarse_side, std::uint64_t recipe_seed,
             SeedPattern pattern = SeedPattern::jittered, double jitter = 0, std::int64_t period = 0);

    double coarse_side() const { return side_; }
    /// The coarse cell that holds the point. Throws InputError beyond 2^24 coarse cells from the origin.
    glm::i64vec3 block_index(dvec3 p) const;
    /// The box of a coarse cell, mm.
    Box block_box(glm::i64vec3 index) const;
    /// A coarse cell, made on first use. Throws InputError where the density is not positive and finite, or
    /// so high that more than 15 levels or 4 million nodes would be needed.
    std::shared_ptr<const SeedBlock> block(glm::i64vec3 index) const;
    /// All seeds in the closed box, by key.
    std::vector<Seed> seeds_in(const Box& box) const;

  private:
    struct Growth;
    /// The coarse cell whose random numbers one has.
    glm::i64vec3 original(glm::i64vec3 index) const;
    SeedBlock make_block(glm::i64vec3 index) const;
    bool is_patterned() const { return pattern_ != SeedPattern::jittered; }
    void split(Growth& growth, std::size_t node, glm::i64vec3 corner) const;
    void integrate(Growth& growth) const;
    void deal(Growth& growth, std::size_t node, glm::i64vec3 corner, std::uint32_t count) const;
    void place(Growth& growth, const CounterHash& hash, int level, glm::i64vec3 corner,
               std::uint32_t count) const;
    void place_bcc(Growth& growth, const CounterHash& hash, int level, glm::i64vec3 corner) const;

    std::shared_ptr<const Density> density_;
    double side_;
    std::uint64_t recipe_seed_;
    SeedPattern pattern_;
    std::int64_t jitter_;  ///< in 2^-20
    std::int64_t period_;  ///< coarse cells; 0: none
    mutable CellCache<SeedBlock> blocks_;
};

}  // namespace lamella
