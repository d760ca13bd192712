// A multigrid preconditioner for elastic structures on periodic grids.
#pragma once

#include <memory>
#include <vector>

#include "procedural/elasticity/elastic_grid.h"

namespace lamella {

/// One V-cycle: solves K x = b roughly, for six load cases at once. Each coarser grid has half as many
/// elements a side, whose stiffness is exactly that of the finer ones under trilinear displacements
/// (Galerkin), so that thin struts keep what stiffness they have; void has none. Smoothing by Chebyshev's
/// polynomials of the second degree over blocks of a node. In single precision, symmetric and positive
/// definite.
class ElasticMultigrid {
  public:
    /// Sides are halved while all of them are even and at least four.
    ElasticMultigrid(const ElementMask& elements, const HexElement& element);
    ~ElasticMultigrid();

    const ElasticGrid& grid() const;
    int levels() const;
    /// x is roughly the solution for b; both have node_numbers for each node.
    void solve(std::span<const float> b, std::span<float> x);

  private:
    struct Level;
    struct Elements;
    void add_level(const ElementMask& mask, const Elements& elements);
    void cycle(std::size_t level);

    std::vector<std::unique_ptr<Level>> levels_;
};

}  // namespace lamella
