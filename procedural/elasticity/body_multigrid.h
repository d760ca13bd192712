// BodyMultigrid: a multigrid preconditioner for elastic bodies with a modulus per element and fixed nodes.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "engine/base/cancel_token.h"
#include "procedural/elasticity/elastic_body.h"

namespace lamella {

/// One cycle: solves K x = b approximately. Each coarser grid has elements of twice the size; its stiffness
/// is that of the finer one under multilinear displacements that vanish where nodes are fixed (Galerkin).
/// Only the finest grid has no stencils. The finest grid visits the next one once, all others twice (W). The
/// smoother is a Chebyshev polynomial of degree three, preconditioned by the diagonal. The cycle works in
/// single precision; it is symmetric and positive definite.
template <std::size_t Dim>
class BodyMultigrid {
  public:
    /// Keeps a reference to the body. `cancel` may be null.
    explicit BodyMultigrid(const ElasticBody<Dim>& body, const CancelToken* cancel = nullptr);
    ~BodyMultigrid();
    BodyMultigrid(const BodyMultigrid&) = delete;
    BodyMultigrid& operator=(const BodyMultigrid&) = delete;

    /// Makes the stiffness of all grids from the moduli of the elements, by element number; 0: void. Throws
    /// Interrupted once cancelled.
    void set_moduli(std::span<const float> moduli);
    /// The right-hand side of the next cycle. Values at fixed nodes are not used.
    NodalVector<Dim, float>& right();
    /// Runs a cycle; returns the approximate solution, 0 where nodes are fixed or touch no element.
    const NodalVector<Dim, float>& solve();
    const NodeRuns& used() const;
    int levels() const { return static_cast<int>(levels_.size()); }

  private:
    struct Level;
    void cycle(std::size_t level);

    const ElasticBody<Dim>& body_;
    const CancelToken* cancel_;
    std::vector<std::unique_ptr<Level>> levels_;
};

extern template class BodyMultigrid<2>;
extern template class BodyMultigrid<3>;

}  // namespace lamella
