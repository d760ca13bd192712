// The beams of a foam by place: units of cells computed once, shared by all layers in flight.
#pragma once

#include <cstdint>
#include <vector>

#include "procedural/foam_beams.h"

namespace lamella {

/// The beams owned by the seeds of one unit: a tree node of at most 64 seeds, or one of its four slabs in z
/// when it has more than 16.
struct FoamUnit {
    std::vector<Beam> beams;
    Box extent;  ///< of the beams' solids, mm
    std::size_t bytes() const { return sizeof(FoamUnit) + beams.capacity() * sizeof(Beam); }
    Interval z_extent() const { return {extent.lo.z, extent.hi.z}; }
};

/// Answers which beams touch a box. Thread-safe; the answers are pure functions of the tree and the radius.
///
/// Which units matter: every point of an edge of a seed's cell is at least as near to that seed as to any
/// other, so its distance to the seed is at most the radius of the largest empty ball centred there, which
/// SeedBlock::hole bounds: at most sqrt(3) coarse sides anywhere, sqrt(3) octants where every octant of a
/// leaf has its seed. A unit matters only if its box is within that reach plus the largest radius of the
/// query.
class FoamUnits {
  public:
    /// `cache_bytes` bounds the memory of the cached units (CellCache says how).
    FoamUnits(std::shared_ptr<const SeedTree> tree, NodeRadius radius, std::size_t cache_bytes);

    /// Every beam whose solid touches the box, once, in the order of units (coarse cells by z, y, x; nodes
    /// depth first; slabs upwards) and within a unit in the order of keys.
    std::vector<Beam> beams_touching(const Box& box) const;

  private:
    /// How far the cells of a coarse cell's seeds reach.
    struct Reach {
        double distance;
        Interval z;
        std::size_t bytes() const { return sizeof(Reach); }
        Interval z_extent() const { return z; }
    };
    /// What one query passes on.
    struct Request {
        const Box& box;
        double z;
        std::vector<Beam> beams;
    };

    double reach(glm::i64vec3 index, double z) const;
    void visit(const SeedBlock& block, std::size_t node, double within, Request& request) const;
    void collect(const SeedBlock& block, std::size_t node, double within, Request& request) const;
    FoamUnit make(const SeedBlock& block, const SeedNode& node, const Box& part, RingSearch& rings,
                  bool gathered) const;

    std::shared_ptr<const SeedTree> tree_;
    NodeRadius radius_;
    mutable CellCache<FoamUnit> units_;
    mutable CellCache<Reach> reaches_;
};

}  // namespace lamella
