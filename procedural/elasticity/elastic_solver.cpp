// Preconditioned conjugate gradients.
#include "procedural/elasticity/elastic_solver.h"

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"

namespace lamella {

namespace {

template <std::size_t Dim>
ElasticBody<Dim> checked(ElasticBody<Dim> body) {
    if (std::ranges::all_of(body.present, [](std::uint8_t p) { return p == 0; }))
        throw InputError("an elastic body has no elements");
    // A node that is held beside the body holds nothing.
    const auto corners = body.grid.corner_steps();
    bool held = false;
    for (std::size_t e = 0; e < body.present.size() && !held; ++e) {
        if (body.present[e] == 0) continue;
        held = std::ranges::any_of(corners, [&](std::ptrdiff_t corner) {
            return body.fixed[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(e) + corner)] != 0;
        });
    }
    if (!held) throw InputError("an elastic body is not held anywhere");
    return body;
}

}  // namespace

template <std::size_t Dim>
ElasticSolver<Dim>::ElasticSolver(ElasticBody<Dim> body, const ElasticSolverOptions& options)
    : body_(checked(std::move(body))),
      options_(options),
      multigrid_(body_, options.cancel),
      rest_(body_.grid.size()),
      way_(body_.grid.size()),
      force_(body_.grid.size()) {
    constexpr std::size_t n = GridElement<Dim>::unknowns;
    for (std::size_t i = 0; i < n * n; ++i) elements_.stiffness[i] = body_.element.stiffness[i / n][i % n];
    elements_.corners = body_.grid.corner_steps();
}

template <std::size_t Dim>
void ElasticSolver<Dim>::set_moduli(std::vector<double> moduli) {
    if (moduli.size() != body_.grid.size()) throw InputError("moduli: one number an element is needed");
    moduli_ = std::move(moduli);
    elements_.moduli = moduli_.data();
    single_moduli_.assign(moduli_.begin(), moduli_.end());
    multigrid_.set_moduli(single_moduli_);
}

/// Computes K u, 0 at fixed nodes. Returns u . K u.
template <std::size_t Dim>
double ElasticSolver<Dim>::multiply_by_stiffness(const Vector& u, Vector& forces) const {
    return multigrid_.used().sum([&](std::size_t begin, std::size_t end) {
        std::array<double*, Dim> out;
        for (std::size_t d = 0; d < Dim; ++d) out[d] = forces.along[d].data() + begin;
        multiply(elements_, u.data(), out, begin, end);
        double sum = 0;
        for (std::size_t d = 0; d < Dim; ++d) {
            for (std::size_t i = begin; i < end; ++i) {
                if ((body_.fixed[i] >> d & 1) != 0) forces.along[d][i] = 0;
                sum += u.along[d][i] * forces.along[d][i];
            }
        }
        return sum;
    });
}

template <std::size_t Dim>
double ElasticSolver<Dim>::work(const Vector& forces, const Vector& displacements) const {
    return multigrid_.used().sum([&](std::size_t begin, std::size_t end) {
        double sum = 0;
        for (std::size_t d = 0; d < Dim; ++d) {
            for (std::size_t i = begin; i < end; ++i) sum += forces.along[d][i] * displacements.along[d][i];
        }
        return sum;
    });
}

template <std::size_t Dim>
int ElasticSolver<Dim>::solve(const Vector& forces, Vector& u) {
    const NodeRuns& runs = multigrid_.used();
    const auto for_each_number = [&](const auto& visit) {
        runs.for_each([&](std::size_t begin, std::size_t end) {
            for (std::size_t d = 0; d < Dim; ++d) {
                for (std::size_t i = begin; i < end; ++i) visit(d, i);
            }
        });
    };
    const auto sum = [&](const auto& term) {
        return runs.sum([&](std::size_t begin, std::size_t end) {
            double total = 0;
            for (std::size_t d = 0; d < Dim; ++d) {
                for (std::size_t i = begin; i < end; ++i) total += term(d, i);
            }
            return total;
        });
    };
    for_each_number([&](std::size_t d, std::size_t i) {
        if ((body_.fixed[i] >> d & 1) != 0) u.along[d][i] = 0;
    });
    multiply_by_stiffness(u, force_);
    for_each_number([&](std::size_t d, std::size_t i) {
        const bool fixed = (body_.fixed[i] >> d & 1) != 0;
        rest_.along[d][i] = fixed ? 0 : forces.along[d][i] - force_.along[d][i];
        way_.along[d][i] = 0;
    });
    const double load = std::sqrt(sum([&](std::size_t d, std::size_t i) {
        const double f = (body_.fixed[i] >> d & 1) != 0 ? 0 : forces.along[d][i];
        return f * f;
    }));
    double before = 0;
    for (int iteration = 0;; ++iteration) {
        const double left = std::sqrt(
            sum([&](std::size_t d, std::size_t i) { return rest_.along[d][i] * rest_.along[d][i]; }));
        if (!(left > options_.tolerance * load)) return iteration;
        if (iteration == options_.max_iterations) {
            throw FaultError("the displacements of a body were not found in " +
                             std::to_string(options_.max_iterations) + " iterations");
        }
        stop_if_cancelled(options_.cancel);
        // Scaled to 1 for single precision.
        NodalVector<Dim, float>& right = multigrid_.right();
        const double scale = 1 / left;
        for_each_number([&](std::size_t d, std::size_t i) {
            right.along[d][i] = static_cast<float>(rest_.along[d][i] * scale);
        });
        const NodalVector<Dim, float>& eased = multigrid_.solve();
        const double now = left * sum([&](std::size_t d, std::size_t i) {
                               return rest_.along[d][i] * static_cast<double>(eased.along[d][i]);
                           });
        const double keep = before > 0 ? now / before : 0;
        for_each_number([&](std::size_t d, std::size_t i) {
            way_.along[d][i] = left * static_cast<double>(eased.along[d][i]) + keep * way_.along[d][i];
        });
        const double energy = multiply_by_stiffness(way_, force_);
        const double length = energy > 0 ? now / energy : 0;
        for_each_number([&](std::size_t d, std::size_t i) {
            u.along[d][i] += length * way_.along[d][i];
            rest_.along[d][i] -= length * force_.along[d][i];
        });
        before = now;
    }
}

template <std::size_t Dim>
std::vector<double> ElasticSolver<Dim>::unit_energies(const Vector& displacements) const {
    std::vector<double> energies(body_.grid.size());
    multigrid_.used().for_each([&](std::size_t begin, std::size_t end) {
        element_energies(elements_, displacements.data(), energies.data(), begin, end);
    });
    for (std::size_t e = 0; e < energies.size(); ++e) {
        if (body_.present[e] == 0) energies[e] = 0;
    }
    return energies;
}

template class ElasticSolver<2>;
template class ElasticSolver<3>;

}  // namespace lamella
