// Which seeds clip a cell, and in which order: from a list, best first over the tree, or in rings of a
// lattice.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "procedural/voronoi/seed_tree.h"
#include "procedural/voronoi/voronoi_cell.h"

namespace lamella {

/// The cell of seeds[own] within a cube of the given half side about it; identifiers are indices into
/// `seeds`. Seeds are clipped by distance, then key. Of equal positions the lowest key has the cell; false
/// (and no cell) for the others.
bool cell_among(std::span<const Seed> seeds, std::size_t own, double half_side, VoronoiCell& cell);

/// Cells in any density. Visits the tree best first and skips every node that could not cut the cell so far.
/// Not thread-safe; reuse one per thread.
class TreeSearch {
  public:
    explicit TreeSearch(const SeedTree& tree) : tree_(&tree) {}
    /// The exact cell of a seed of the tree; identifiers are indices into sites().
    void cell(const Seed& own, VoronoiCell& cell);
    /// The seeds that the last cell was clipped by.
    std::span<const Seed> sites() const { return sites_; }

  private:
    struct Visit {
        double distance_squared;
        const SeedBlock* block;  ///< null: the ring of coarse cells `node` steps away
        std::int32_t node;
    };
    void push(const Visit& visit);
    const SeedBlock& block(glm::i64vec3 index);
    void push_ring(std::int64_t ring, const Seed& own, glm::i64vec3 center);
    void clip_leaf(const SeedBlock& block, const SeedNode& node, const Seed& own, VoronoiCell& cell);

    const SeedTree* tree_;
    std::vector<Visit> heap_;
    std::vector<Seed> sites_;
    std::vector<std::shared_ptr<const SeedBlock>> blocks_;  ///< seen since construction
};

/// Cells where all leaves about have one level: the octants of the leaves form a lattice with at most one
/// seed each, gathered once for many cells; a cell visits the lattice's 5^3 block by distance, then what the
/// balls at its vertices still reach. Gives the cells of TreeSearch, bit for bit. Not thread-safe.
class RingSearch {
  public:
    explicit RingSearch(const SeedTree& tree) : tree_(&tree) {}
    /// Gathers the seeds about a box. False when leaves there have several levels.
    bool gather(const Box& box);
    /// The gathered seeds, in the order of keys; identifiers are indices into this.
    std::span<const Seed> sites() const { return sites_; }
    /// The exact cell of sites()[own]. False when it may reach beyond what was gathered.
    bool cell(std::size_t own, VoronoiCell& cell);

  private:
    struct Candidate {
        double distance_squared;
        std::int32_t site;
    };
    glm::ivec3 octant_of(dvec3 p) const;
    std::size_t slot(glm::ivec3 octant) const {
        const auto at = [](int v) { return static_cast<std::size_t>(v); };
        return (at(octant.z) * at(size_.y) + at(octant.y)) * at(size_.x) + at(octant.x);
    }
    void collect_block(glm::ivec3 center, dvec3 own, double limit_squared);
    bool clip_beyond_block(glm::ivec3 center, dvec3 own, VoronoiCell& cell);

    const SeedTree* tree_;
    double spacing_ = 1;  ///< side of an octant of a leaf, mm
    double octants_per_mm_ = 1;
    dvec3 origin_{0};                    ///< lower corner of octant (0, 0, 0)
    glm::ivec3 size_{0};                 ///< octants per axis
    std::vector<std::int32_t> site_at_;  ///< by octant, -1 for none
    std::vector<double> x_, y_, z_;      ///< by octant; far away for none
    std::vector<Seed> sites_;
    std::vector<Candidate> candidates_, sorted_;
};

}  // namespace lamella
