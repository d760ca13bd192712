// ElasticMultigrid: a multigrid preconditioner for elastic structures on periodic grids.
#pragma once

#include <memory>
#include <vector>

#include "engine/base/cancel_token.h"
#include "procedural/elasticity/elastic_grid.h"

namespace lamella {

/// One V-cycle: solves K x = b approximately, for six load cases at once. Each coarser grid has half as many
/// elements per side. The stiffness of a coarse element is exactly that of its children under trilinear
/// displacements (Galerkin), so thin struts keep their stiffness; void has none. The smoother is a Chebyshev
/// polynomial of degree two, preconditioned by the 3x3 diagonal block of each node. The cycle works in single
/// precision; it is symmetric and positive definite.
class ElasticMultigrid {
  public:
    /// Coarsens as long as all sides are even and at least four elements. Building and solving throw
    /// Interrupted within a sweep over the nodes once `cancel` (may be null) is set.
    ElasticMultigrid(const ElementMask& elements, const HexElement& element,
                     const CancelToken* cancel = nullptr);
    ~ElasticMultigrid();

    const ElasticGrid& grid() const;
    int levels() const;
    /// Computes an approximate solution x for the right-hand side b. Both have node_numbers numbers per node.
    void solve(std::span<const float> b, std::span<float> x);

  private:
    struct Level;
    struct Elements;
    void add_level(const ElementMask& mask, const Elements& elements);
    void cycle(std::size_t level);

    const CancelToken* cancel_;
    std::vector<std::unique_ptr<Level>> levels_;
};

}  // namespace lamella
