// Compliance: how far the loads of a design move, and its gradient.
#pragma once

#include "procedural/optimization/shared_solves.h"
#include "procedural/optimization/topology_problem.h"

namespace lamella {

/// Finite element analysis of densities. Keeps the displacements of the last design, from which the next
/// solve begins.
template <std::size_t Dim>
class Compliance {
  public:
    /// Keeps a reference to the problem. `shared`: the processes that share the solves; null for one.
    Compliance(const TopologyProblem<Dim>& problem, const ElasticSolverOptions& options,
               SharedSolves* shared = nullptr);

    struct Result {
        double total = 0;              ///< sum over cases of weight times compliance
        std::vector<double> by_case;   ///< unweighted
        std::vector<double> gradient;  ///< of the total with respect to the densities
        int iterations = 0;            ///< of the solver, for the slowest case
    };
    Result evaluate(std::span<const double> density);
    /// Sets where the next solves begin: displacements by case, then direction. Nothing: from rest. Throws
    /// InputError for another number of cases, directions or nodes.
    void set_displacements(const std::vector<std::vector<double>>& by_case);
    std::vector<std::vector<double>> all_displacements() const;
    /// The displacements of a case for the last design, before scaling by modulus and size.
    const NodalVector<Dim, double>& displacements(std::size_t load_case) const {
        return displacements_[load_case];
    }

  private:
    bool is_heavy() const;
    void add_weight(std::span<const double> density, NodalVector<Dim, double>& forces) const;
    const NodalVector<Dim, double>& forces(std::size_t load_case, std::span<const double> density,
                                           NodalVector<Dim, double>& with_weight) const;
    int solve_cases(std::span<const double> density);
    void add_case(std::size_t load_case, std::span<const double> density, Result& result) const;

    const TopologyProblem<Dim>& problem_;
    std::vector<std::size_t> numbers_;
    ElasticSolver<Dim> solver_;
    SharedSolves* shared_;
    std::uint64_t moduli_hash_ = 0;  ///< of the last design, with others to share the solves
    std::vector<NodalVector<Dim, double>> displacements_;
};

extern template class Compliance<2>;
extern template class Compliance<3>;

}  // namespace lamella
