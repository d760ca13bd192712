// DirectSolver: displacements of an elastic body by a sparse Cholesky factorisation.
#pragma once

#include <memory>
#include <span>

#include "procedural/elasticity/elastic_body.h"

namespace lamella {

/// Factorises the stiffness of a body once and solves for many loads. Suits slender frames, on which
/// multigrid converges slowly: short cuts part them, so the factor stays small.
class DirectSolver {
  public:
    /// Returns null if the factorisation needs more than `most` multiplications. `moduli` are by element
    /// number, more than 0 for elements of the body. Throws InputError when a part of the body can move
    /// freely.
    static std::unique_ptr<DirectSolver> make(const ElasticBody<3>& body, std::span<const double> moduli,
                                              double most);
    ~DirectSolver();
    DirectSolver(const DirectSolver&) = delete;
    DirectSolver& operator=(const DirectSolver&) = delete;

    /// Returns the displacements under nodal forces, 0 at fixed nodes and beside the body.
    NodalVector<3, double> solve(const NodalVector<3, double>& forces) const;

  private:
    struct Factor;
    explicit DirectSolver(std::unique_ptr<Factor> factor);
    std::unique_ptr<Factor> factor_;
};

}  // namespace lamella
