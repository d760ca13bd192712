// CellOctree: an octree over all of space whose cube sizes follow a grading; adjacent cubes differ by at most
// one level.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "engine/field/grading.h"
#include "procedural/voronoi/cell_cache.h"

namespace lamella {

/// A cube of the octree: cube `index` in the lattice of cubes of side coarse_side / 2^level.
struct OctreeCell {
    glm::i64vec3 index;
    int level;
    friend bool operator==(const OctreeCell&, const OctreeCell&) = default;
};

/// A balanced octree over all of space. Coarse cubes have the largest size that the grading takes over the
/// region, and a corner at the region's lower corner. A cube is divided into eight if the size somewhere in
/// it is below its side / sqrt(2), or if otherwise an adjacent cube (at a face, an edge or a corner) would
/// have less than half its side. Outside the region the grading is evaluated at the nearest point of the
/// region. Logically immutable and thread-safe; a pure function of the grading and the region.
class CellOctree {
  public:
    static constexpr int max_halvings = 6;

    /// Throws InputError unless sizes are positive and finite and differ by at most a factor of
    /// 2^max_halvings.
    CellOctree(GradingPtr size, const Box& region, std::size_t cache_bytes);

    double coarse_side() const { return coarse_side_; }
    /// The region's lower corner, which is a corner of a coarse cube.
    dvec3 origin() const { return region_.lo; }
    const Box& region() const { return region_; }
    /// Points farther from the origin along some axis, in coarse sides, are in no cube.
    static constexpr double farthest = 1e9;
    /// Upper bound of the level of any cube: the smallest have side coarse_side / 2^levels or more.
    int levels() const { return levels_; }
    double side(int level) const { return coarse_side_ / static_cast<double>(1 << level); }
    Box box(const OctreeCell& cell) const;
    /// Calls visit for every leaf cube that meets the closed box: coarse cubes by z, y, x; inside them depth
    /// first.
    void for_each(const Box& box, const std::function<void(const OctreeCell&)>& visit) const;

  private:
    /// The divided cubes within one coarse cube, by level, sorted.
    struct Divisions {
        std::vector<std::vector<glm::i64vec3>> by_level;
        Interval z;
        bool contains(const OctreeCell& cell) const;
        std::size_t bytes() const;
        Interval z_extent() const { return z; }
    };
    using DivisionsPtr = CellCache<Divisions>::Pointer;

    bool too_large(const OctreeCell& cell) const;
    void divide(const OctreeCell& cell, Divisions& wanted) const;
    DivisionsPtr wanted(glm::i64vec3 coarse) const;
    DivisionsPtr balanced(glm::i64vec3 coarse) const;
    Divisions balance(glm::i64vec3 coarse) const;
    void visit_cells(const OctreeCell& cell, const Divisions* divisions, const Box& box,
                     const std::function<void(const OctreeCell&)>& visit) const;

    GradingPtr size_;
    Box region_;
    double coarse_side_, min_size_;
    int levels_ = 0;
    mutable CellCache<Divisions> wanted_, balanced_;
};

}  // namespace lamella
