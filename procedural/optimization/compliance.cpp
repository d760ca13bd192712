// Moduli from densities, one solve a load case, and energies back to gradients.
#include "procedural/optimization/compliance.h"

#include <algorithm>

#include "engine/base/error.h"
#include "procedural/optimization/variable_blocks.h"

namespace lamella {

namespace {

template <std::size_t Dim>
ElasticBody<Dim> body_in_use(const TopologyProblem<Dim>& problem, const std::vector<std::size_t>& numbers) {
    if (problem.use.size() != numbers.size())
        throw InputError("a topology problem names the use of " + std::to_string(problem.use.size()) +
                         " elements; its grid has " + std::to_string(numbers.size()));
    if (problem.cases.empty()) throw InputError("a topology problem has no load case");
    ElasticBody<Dim> body = problem.body;
    for (std::size_t i = 0; i < numbers.size(); ++i)
        body.present[numbers[i]] = problem.use[i] != ElementUse::outside;
    return body;
}

}  // namespace

template <std::size_t Dim>
Compliance<Dim>::Compliance(const TopologyProblem<Dim>& problem, const ElasticSolverOptions& options)
    : problem_(problem),
      numbers_(element_numbers(problem.body.grid)),
      solver_(body_in_use(problem, numbers_), options),
      displacements_(problem.cases.size(), NodalVector<Dim, double>(problem.body.grid.size())) {}

/// Adds the weight of the elements, spread evenly over their corners.
template <std::size_t Dim>
void Compliance<Dim>::add_weight(std::span<const double> density, NodalVector<Dim, double>& forces) const {
    const auto corners = problem_.body.grid.corner_steps();
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
        if (problem_.use[i] == ElementUse::outside) continue;
        for (const std::ptrdiff_t corner : corners) {
            const auto node = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(numbers_[i]) + corner);
            for (std::size_t d = 0; d < Dim; ++d)
                forces.along[d][node] +=
                    density[i] * problem_.weight[d] / static_cast<double>(corners.size());
        }
    }
}

template <std::size_t Dim>
void Compliance<Dim>::set_displacements(const std::vector<std::vector<double>>& by_case) {
    const std::size_t size = problem_.body.grid.size();
    const bool fits =
        by_case.empty() || (by_case.size() == displacements_.size() * Dim &&
                            std::ranges::all_of(by_case, [&](const auto& u) { return u.size() == size; }));
    if (!fits) throw InputError("displacements of other load cases or of another grid");
    for (std::size_t i = 0; i < displacements_.size() * Dim; ++i) {
        std::vector<double>& along = displacements_[i / Dim].along[i % Dim];
        if (by_case.empty()) {
            std::ranges::fill(along, 0.0);
        } else {
            along = by_case[i];
        }
    }
}

template <std::size_t Dim>
std::vector<std::vector<double>> Compliance<Dim>::all_displacements() const {
    std::vector<std::vector<double>> by_case;
    for (const NodalVector<Dim, double>& u : displacements_)
        by_case.insert(by_case.end(), u.along.begin(), u.along.end());
    return by_case;
}

template <std::size_t Dim>
auto Compliance<Dim>::evaluate(std::span<const double> density) -> Result {
    std::vector<double> moduli(problem_.body.grid.size());
    for_each_variable_block(density.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            if (problem_.use[i] != ElementUse::outside)
                moduli[numbers_[i]] = problem_.law->modulus(density[i]);
        }
    });
    solver_.set_moduli(std::move(moduli));
    const bool heavy = std::ranges::any_of(problem_.weight, [](double w) { return w != 0; });
    Result result;
    result.gradient.assign(density.size(), 0.0);
    for (std::size_t c = 0; c < problem_.cases.size(); ++c) {
        const LoadCase<Dim>& load = problem_.cases[c];
        NodalVector<Dim, double>& u = displacements_[c];
        const NodalVector<Dim, double>* forces = &load.forces;
        NodalVector<Dim, double> with_weight;
        if (heavy) {
            with_weight = load.forces;
            add_weight(density, with_weight);
            forces = &with_weight;
        }
        result.iterations = std::max(result.iterations, solver_.solve(*forces, u));
        result.by_case.push_back(solver_.work(*forces, u));
        result.total += load.weight * result.by_case.back();
        const std::vector<double> energies = solver_.unit_energies(u);
        const auto corners = problem_.body.grid.corner_steps();
        for_each_variable_block(density.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                if (problem_.use[i] == ElementUse::outside) continue;
                double slope = -problem_.law->slope(density[i]) * energies[numbers_[i]];
                if (heavy) {
                    for (const std::ptrdiff_t corner : corners) {
                        const auto node =
                            static_cast<std::size_t>(static_cast<std::ptrdiff_t>(numbers_[i]) + corner);
                        for (std::size_t d = 0; d < Dim; ++d)
                            slope += 2 * u.along[d][node] * problem_.weight[d] /
                                     static_cast<double>(corners.size());
                    }
                }
                result.gradient[i] += load.weight * slope;
            }
        });
    }
    return result;
}

template class Compliance<2>;
template class Compliance<3>;

}  // namespace lamella
