// SeedTree: the seeds of a foam, in a lattice of coarse cells, each an octree whose leaves place jittered
// seeds.
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

/// A total order of all seeds: by coarse cell (z, y, x), then by position in the tree's depth-first order.
/// Depends on the recipe alone.
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

/// A node of a coarse cell's octree. Seeds are stored in depth-first order, so those of a node are
/// contiguous.
struct SeedNode {
    Box box;                        ///< mm; contains its seeds
    int level = 0;                  ///< side = coarse side / 2^level
    std::int32_t first_child = -1;  ///< index of the first of eight consecutive children, -1 for a leaf
    std::uint32_t first_seed = 0;
    std::uint32_t seed_count = 0;
};

/// How a leaf places its seeds.
enum class SeedPattern : unsigned char {
    jittered,  ///< each uniform in its own octant: an irregular foam
    bcc        ///< two per leaf, body-centred cubic: truncated octahedra (Kelvin's foam)
};

/// One coarse cell with its octree and seeds. Immutable once made.
struct SeedBlock {
    glm::i64vec3 index{0};
    std::vector<SeedNode> nodes;   ///< nodes[0] is the coarse cell itself
    std::vector<dvec3> positions;  ///< mm, in key order
    /// Upper bound of the radius of an empty ball centred in this coarse cell, mm: the longest diagonal among
    /// the smallest boxes that each hold a seed and together cover the cell.
    double hole = 0;
    /// The level of all leaves if they share one and no octant of a leaf holds two seeds; else -1.
    int leaf_level = -1;

    SeedKey key(std::uint32_t seed) const;
    Seed seed(std::uint32_t i) const { return {positions[i], key(i)}; }
    std::size_t bytes() const;
    Interval z_extent() const { return {nodes[0].box.lo.z, nodes[0].box.hi.z}; }
};

/// Seeds everywhere in space, as a pure function of (density, coarse side, recipe seed).
///
/// A node is split while its maximum density times its volume exceeds eight. The density is integrated over
/// the leaves and summed upwards. The seed count of a coarse cell is its integral rounded up or down (decided
/// by one hash), at least one. A node's count is distributed to its octants by systematic sampling (a random
/// order of the octants, one uniform offset): counts add up, and each differs from its expected value by less
/// than one. A leaf puts its seeds into different octants, each uniform in its octant: stratified jitter
/// (Martinez, Dumas, Lefebvre 2016, supplement; the distribution of counts is ours). In the pattern bcc every
/// leaf holds two seeds, and a node is split where it would hold more than sqrt(32): cell sizes change by
/// factors of two. Positions are integer multiples of 2^-38 of the coarse side, converted to double once.
/// Thread-safe.
class SeedTree {
  public:
    /// `jitter` in [0, 1] moves the seeds of a regular pattern at random along each axis, by up to that share
    /// of a quarter of the leaf's side. If `period` is above 0, the random numbers repeat after so many
    /// coarse cells along each axis; the seeds repeat where the density does. Throws InputError unless the
    /// side is positive and finite.
    SeedTree(std::shared_ptr<const Density> density, double coarse_side, std::uint64_t recipe_seed,
             SeedPattern pattern = SeedPattern::jittered, double jitter = 0, std::int64_t period = 0);

    double coarse_side() const { return side_; }
    /// Returns the coarse cell that contains the point. Throws InputError beyond 2^24 coarse cells from the
    /// origin.
    glm::i64vec3 block_index(dvec3 p) const;
    /// Returns the box of a coarse cell, mm.
    Box block_box(glm::i64vec3 index) const;
    /// Returns a coarse cell, made on first use and cached. Throws InputError where the density is not
    /// positive and finite, or so high that more than 15 levels or 4 million nodes would be needed.
    std::shared_ptr<const SeedBlock> block(glm::i64vec3 index) const;
    /// Returns all seeds in the closed box, in key order.
    std::vector<Seed> seeds_in(const Box& box) const;

  private:
    struct Growth;
    /// Maps a coarse cell to the one whose random numbers it uses; differs from `index` only if seeds repeat.
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
    std::int64_t jitter_;  ///< in units of 2^-20
    std::int64_t period_;  ///< coarse cells; 0: not periodic
    mutable CellCache<SeedBlock> blocks_;
};

}  // namespace lamella
