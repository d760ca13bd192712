// CellOctree: space divided into cubes whose sizes follow a grading by halving, neighbours alike to one
// halving.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "engine/field/grading.h"
#include "procedural/voronoi/cell_cache.h"

namespace lamella {

/// A cube of the octree: cube `index` of the lattice of cubes of side coarse_side / 2^level.
struct OctreeCell {
    glm::i64vec3 index;
    int level;
    friend bool operator==(const OctreeCell&, const OctreeCell&) = default;
};

/// Cubes over all of space. The coarse ones have the largest size asked for over the region and a corner at
/// the region's lower corner. A cube is divided in eight while some size asked for in it is below its side /
/// sqrt(2), and where otherwise a cube that touches it (at a face, an edge or a corner) would be of less than
/// half its side. Beyond the region the grading counts at the nearest point of it. Immutable to its callers
/// and thread-safe; a pure function of the grading and the region.
class CellOctree {
  public:
    static constexpr int max_halvings = 6;

    /// Throws InputError where sizes are not positive and finite or differ by more than 2^max_halvings.
    CellOctree(GradingPtr size, const Box& region, std::size_t cache_bytes);

    double coarse_side() const { return coarse_side_; }
    /// A corner of a coarse cube: the region's lower corner.
    dvec3 origin() const { return region_.lo; }
    const Box& region() const { return region_; }
    /// Points farther from the origin along some axis, in coarse sides, belong to no cube.
    static constexpr double farthest = 1e9;
    /// The smallest cubes have side coarse_side / 2^levels at least.
    int levels() const { return levels_; }
    double side(int level) const { return coarse_side_ / static_cast<double>(1 << level); }
    Box box(const OctreeCell& cell) const;
    /// The undivided cube that holds the point (its lower faces belong to it).
    OctreeCell cell_at(dvec3 p) const;
    /// Calls visit for every undivided cube that meets the closed box: coarse ones by z, y, x, inside them
    /// depth first.
    void for_each(const Box& box, const std::function<void(const OctreeCell&)>& visit) const;

  private:
    /// The divided cubes of one coarse cube, by level and sorted.
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
