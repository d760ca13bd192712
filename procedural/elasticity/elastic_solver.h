// ElasticSolver: the displacements of an elastic body under loads.
#pragma once

#include <functional>

#include "procedural/elasticity/body_multigrid.h"
#include "procedural/elasticity/grid_stiffness.h"

namespace lamella {

struct ElasticSolverOptions {
    double tolerance = 1e-5;  ///< relative residual: norm of the residual forces over that of the loads
    int max_iterations = 1000;
    const CancelToken* cancel = nullptr;  ///< may be null
};

/// Solves K u = f by conjugate gradients in double precision, preconditioned by a multigrid cycle. Runs on
/// the threads of the calling arena; results do not depend on their number.
template <std::size_t Dim>
class ElasticSolver {
  public:
    using Vector = NodalVector<Dim, double>;

    /// Keeps a copy of the body. Throws InputError when nothing is held fixed or there is no element.
    ElasticSolver(ElasticBody<Dim> body, const ElasticSolverOptions& options);

    const ElasticBody<Dim>& body() const { return body_; }
    /// Sets the modulus of each element, by element number; elements outside the body must have 0, those
    /// inside more than 0.
    void set_moduli(std::vector<double> moduli);
    /// Solves for nodal forces. `displacements` is the first guess and becomes the solution; at fixed nodes
    /// it is set to 0. Returns the number of iterations. Throws FaultError when max_iterations do not
    /// suffice.
    int solve(const Vector& forces, Vector& displacements);
    /// Returns the work of forces on displacements: f . u, the compliance for the solution u.
    double work(const Vector& forces, const Vector& displacements) const;
    /// Returns twice the strain energy of each element, by element number, divided by its modulus.
    std::vector<double> unit_energies(const Vector& displacements) const;

  private:
    double multiply_by_stiffness(const Vector& u, Vector& forces) const;

    ElasticBody<Dim> body_;
    ElasticSolverOptions options_;
    BodyMultigrid<Dim> multigrid_;
    ElementForces<Dim, double> elements_;
    std::vector<double> moduli_;
    std::vector<float> single_moduli_;
    Vector rest_, way_, force_;
};

extern template class ElasticSolver<2>;
extern template class ElasticSolver<3>;

}  // namespace lamella
