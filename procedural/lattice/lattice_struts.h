// LatticeStruts: the struts of a unit cell in every cube of an octree, in integer coordinates, so that cells
// that share a strut agree.
#pragma once

#include <memory>
#include <vector>

#include "procedural/lattice/cell_octree.h"
#include "procedural/lattice/unit_cells.h"

namespace lamella {

/// A strut between two points of the grid of spacing coarse_side / grid_steps. `a` precedes `b` in the order
/// z, y, x.
struct GridStrut {
    glm::i64vec3 a;
    glm::i64vec3 b;
    friend bool operator==(const GridStrut&, const GridStrut&) = default;
};
bool operator<(const GridStrut& s, const GridStrut& t);

/// The struts of all cells. A pure function of the octree and the unit cell; thread-safe.
class LatticeStruts {
  public:
    LatticeStruts(std::shared_ptr<const CellOctree> cells, const std::vector<Strut>& unit_cell);

    const CellOctree& cells() const { return *cells_; }
    /// Upper bound of the average number of struts that a cell owns.
    std::size_t per_cell() const { return cell_.size(); }
    dvec3 position(const glm::i64vec3& grid_point) const;
    /// Returns every strut whose bounding box meets the closed box, once, in an order that does not depend on
    /// the box.
    std::vector<GridStrut> meeting(const Box& box) const;

  private:
    std::shared_ptr<const CellOctree> cells_;
    std::vector<GridStrut> cell_;  ///< of the unit cell, in 2^-20 of its side
    double step_;
};

}  // namespace lamella
