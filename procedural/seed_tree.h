// The seeds of a foam: a lattice of coarse cells, each an octree whose leaves place jittered seeds.
#pragma once

#include <compare>
#include <cstdint>
#include <memory>
#include <vector>

#include "engine/geometry.h"
#include "procedural/cell_cache.h"
#include "procedural/counter_hash.h"
#include "procedural/density.h"

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
/// A coarse cell's count is the floor or the ceiling of the density's integral (one hash decides), at least
/// one. A node is split while the highest density in it times its volume exceeds eight; its count is dealt to
/// its octants by systematic sampling (a random order of the octants, one uniform offset), so that counts add
/// up and each differs from its share by less than one. A leaf puts its seeds into different octants, each
/// uniform in its octant: stratified jitter (Martinez, Dumas, Lefebvre 2016, supplement; the dealing is
/// ours). Positions are integers of 2^-38 of the coarse side, turned to double once. Thread-safe.
class SeedTree {
  public:
    /// Throws InputError unless the side is positive and finite.
    SeedTree(std::shared_ptr<const Density> density, double coarse_side, std::uint64_t recipe_seed);

    double coarse_side() const { return side_; }
    /// The coarse cell that holds the point. Throws InputError beyond 2^24 coarse cells from the origin.
    glm::i64vec3 block_index(dvec3 p) const;
    /// The box of a coarse cell, mm.
    Box block_box(glm::i64vec3 index) const;
    /// A coarse cell, made on first use. Throws InputError where the density is not positive and finite, or
    /// so high that more than 15 levels would be needed.
    std::shared_ptr<const SeedBlock> block(glm::i64vec3 index) const;
    /// All seeds in the closed box, by key.
    std::vector<Seed> seeds_in(const Box& box) const;

  private:
    struct Growth;
    SeedBlock make_block(glm::i64vec3 index) const;
    void grow(Growth& growth, std::size_t node, glm::i64vec3 corner, std::uint32_t count) const;
    void place(Growth& growth, const CounterHash& hash, int level, glm::i64vec3 corner,
               std::uint32_t count) const;

    std::shared_ptr<const Density> density_;
    double side_;
    std::uint64_t recipe_seed_;
    mutable CellCache<SeedBlock> blocks_;
};

}  // namespace lamella
