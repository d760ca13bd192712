// A unit cell laid out over an octree: struts with whole coordinates, so that cells that share one agree.
#pragma once

#include <memory>
#include <vector>

#include "procedural/lattice/cell_octree.h"
#include "procedural/lattice/unit_cells.h"

namespace lamella {

/// A strut between two points of the grid of coarse_side / grid_steps; `a` comes first by z, y, x.
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
    /// The struts that cells own on average, at most.
    std::size_t per_cell() const { return cell_.size(); }
    dvec3 position(const glm::i64vec3& grid_point) const;
    /// Every strut whose bounding box meets the closed box, once, in an order that does not depend on the
    /// box.
    std::vector<GridStrut> meeting(const Box& box) const;

  private:
    std::shared_ptr<const CellOctree> cells_;
    std::vector<GridStrut> cell_;  ///< of one cell, in 2^-20 of its side
    double step_;
};

}  // namespace lamella
