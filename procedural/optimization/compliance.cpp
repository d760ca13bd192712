// Moduli from densities, one solve a load case, and energies back to gradients.
#include "procedural/optimization/compliance.h"

#include <algorithm>
#include <bit>

#include "engine/base/error.h"
#include "procedural/optimization/variable_blocks.h"

namespace lamella {

namespace {

template <std::size_t Dim>
ElasticBody<Dim> body_in_use(const TopologyProblem<Dim>& problem, const std::vector<std::size_t>& numbers) {
    if (problem.use.size() != numbers.size())
        throw InputError("a topology problem names the use of " + std::to_string(problem.use.size()) +
                         " elements; its grid has " + std::to_string(numbers.size()));
    const bool one_each = problem.laws.empty() || problem.law_of.size() == numbers.size();
    if (!one_each) throw InputError("a topology problem of several laws names one of them by element");
    if (problem.cases.empty()) throw InputError("a topology problem has no load case");
    ElasticBody<Dim> body = problem.body;
    for (std::size_t i = 0; i < numbers.size(); ++i)
        body.present[numbers[i]] = problem.use[i] != ElementUse::outside;
    return body;
}

/// FNV-1a over whole numbers instead of bytes.
std::uint64_t hash_of(std::span<const double> numbers) {
    std::uint64_t hash = 0xcbf29ce484222325U;
    for (const double number : numbers) hash = (hash ^ std::bit_cast<std::uint64_t>(number)) * 0x100000001b3U;
    return hash;
}

}  // namespace

template <std::size_t Dim>
Compliance<Dim>::Compliance(const TopologyProblem<Dim>& problem, const ElasticSolverOptions& options,
                            SharedSolves* shared)
    : problem_(problem),
      numbers_(element_numbers(problem.body.grid)),
      solver_(body_in_use(problem, numbers_), options),
      shared_(shared),
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
bool Compliance<Dim>::is_heavy() const {
    return std::ranges::any_of(problem_.weight, [](double w) { return w != 0; });
}

/// Returns the forces of a case; `with_weight` is where they are made of loads and weight.
template <std::size_t Dim>
const NodalVector<Dim, double>& Compliance<Dim>::forces(std::size_t load_case,
                                                        std::span<const double> density,
                                                        NodalVector<Dim, double>& with_weight) const {
    const NodalVector<Dim, double>& loads = problem_.cases[load_case].forces;
    if (!is_heavy()) return loads;
    with_weight = loads;
    add_weight(density, with_weight);
    return with_weight;
}

/// Solves the cases of this process and takes those of others. Returns the most iterations of a case.
template <std::size_t Dim>
int Compliance<Dim>::solve_cases(std::span<const double> density) {
    int most = 0;
    for (std::size_t c = 0; c < problem_.cases.size(); ++c) {
        if (shared_ != nullptr && !shared_->is_solved_here(c)) continue;
        NodalVector<Dim, double>& u = displacements_[c];
        NodalVector<Dim, double> with_weight;
        const int iterations = solver_.solve(forces(c, density, with_weight), u);
        most = std::max(most, iterations);
        if (shared_ != nullptr) shared_->give({moduli_hash_, iterations, {u.along.begin(), u.along.end()}});
    }
    for (std::size_t c = 0; shared_ != nullptr && c < problem_.cases.size(); ++c) {
        if (shared_->is_solved_here(c)) continue;
        SolvedCase solved = shared_->take(c, moduli_hash_);
        if (solved.displacements.size() != Dim)
            throw FaultError("displacements of a load case lack a direction");
        std::ranges::move(solved.displacements, displacements_[c].along.begin());
        most = std::max(most, solved.iterations);
    }
    return most;
}

/// Adds the compliance of a case that is solved, and its gradient.
template <std::size_t Dim>
void Compliance<Dim>::add_case(std::size_t load_case, std::span<const double> density, Result& result) const {
    const NodalVector<Dim, double>& u = displacements_[load_case];
    const double weight = problem_.cases[load_case].weight;
    NodalVector<Dim, double> with_weight;
    result.by_case.push_back(solver_.work(forces(load_case, density, with_weight), u));
    result.total += weight * result.by_case.back();
    const std::vector<double> energies = solver_.unit_energies(u);
    const auto corners = problem_.body.grid.corner_steps();
    const bool heavy = is_heavy();
    for_each_variable_block(density.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            if (problem_.use[i] == ElementUse::outside) continue;
            double slope = -problem_.law_at(i).slope(density[i]) * energies[numbers_[i]];
            if (heavy) {
                for (const std::ptrdiff_t corner : corners) {
                    const auto node =
                        static_cast<std::size_t>(static_cast<std::ptrdiff_t>(numbers_[i]) + corner);
                    for (std::size_t d = 0; d < Dim; ++d)
                        slope +=
                            2 * u.along[d][node] * problem_.weight[d] / static_cast<double>(corners.size());
                }
            }
            result.gradient[i] += weight * slope;
        }
    });
}

template <std::size_t Dim>
auto Compliance<Dim>::evaluate(std::span<const double> density) -> Result {
    std::vector<double> moduli(problem_.body.grid.size());
    for_each_variable_block(density.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            if (problem_.use[i] != ElementUse::outside)
                moduli[numbers_[i]] = problem_.law_at(i).modulus(density[i]);
        }
    });
    if (shared_ != nullptr) moduli_hash_ = hash_of(moduli);
    solver_.set_moduli(std::move(moduli));
    Result result;
    result.gradient.assign(density.size(), 0.0);
    result.iterations = solve_cases(density);
    for (std::size_t c = 0; c < problem_.cases.size(); ++c) add_case(c, density, result);
    return result;
}

template class Compliance<2>;
template class Compliance<3>;

}  // namespace lamella
