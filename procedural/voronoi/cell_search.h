// TreeSearch, RingSearch: exact Voronoi cells, clipped by seeds from a list, from the tree best first, or
// from rings of a lattice.
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

/// Computes cells for any density. Visits the tree best first and prunes every node that cannot cut the cell
/// any more. Not thread-safe; use one per thread.
class TreeSearch {
  public:
    explicit TreeSearch(const SeedTree& tree) : tree_(&tree) {}
    /// Computes the exact cell of a seed of the tree. Plane identifiers are indices into sites().
    void cell(const Seed& own, VoronoiCell& cell);
    /// The seeds that clipped the last cell.
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
    std::vector<std::shared_ptr<const SeedBlock>> blocks_;  ///< all that were used since construction
};

/// Computes cells where all leaves nearby have one level, so that their octants form a lattice with at most
/// one seed each. The lattice is gathered once for many cells. A cell is clipped by the seeds in its 5^3
/// block of octants in order of distance, then by farther seeds within the balls around its vertices. The
/// cells equal those of TreeSearch bit for bit. Not thread-safe.
class RingSearch {
  public:
    explicit RingSearch(const SeedTree& tree) : tree_(&tree) {}
    /// Gathers the seeds around a box. Returns false if the leaves there differ in level.
    bool gather(const Box& box);
    /// The gathered seeds, in the order of keys. Plane identifiers are indices into this list.
    std::span<const Seed> sites() const { return sites_; }
    /// Computes the exact cell of sites()[own]. Returns false if the cell may reach beyond the gathered
    /// seeds.
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
    glm::ivec3 size_{0};                 ///< by octant; very far away for an empty one
    std::vector<std::int32_t> site_at_;  ///< by octant, -1 for none
    std::vector<double> x_, y_, z_;      ///< by octant; far away for none
    std::vector<Seed> sites_;
    std::vector<Candidate> candidates_, sorted_;
};

}  // namespace lamella
