// Numbers the unknowns, assembles, factorises with an approximate minimum degree ordering.
#include "procedural/elasticity/direct_solver.h"

#include <Eigen/SparseCholesky>
#include <array>
#include <utility>
#include <vector>

#include "engine/base/error.h"

namespace lamella {

struct DirectSolver::Factor {
    using SparseMatrix = Eigen::SparseMatrix<double>;
    /// Tells how long the factorisation takes before it begins.
    class Cholesky : public Eigen::SimplicialLLT<SparseMatrix, Eigen::Lower, Eigen::AMDOrdering<int>> {
      public:
        /// Returns the number of multiplications, once the pattern is analysed.
        double work() const {
            double sum = 0;
            for (const int entries : m_nonZerosPerCol) sum += static_cast<double>(entries) * entries;
            return sum;
        }
    };

    std::size_t nodes = 0;
    std::array<std::vector<std::int32_t>, 3> unknown;  ///< by direction and node; -1: none
    Eigen::Index unknowns = 0;
    Cholesky matrix;

    void number(const ElasticBody<3>& body) {
        const auto corners = body.grid.corner_steps();
        nodes = body.grid.size();
        std::vector<std::uint8_t> used(nodes, 0);
        for (std::size_t e = 0; e < body.present.size(); ++e) {
            if (body.present[e] == 0) continue;
            for (const std::ptrdiff_t c : corners)
                used[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(e) + c)] = 1;
        }
        for (auto& along : unknown) along.assign(nodes, -1);
        for (std::size_t node = 0; node < nodes; ++node) {
            for (std::size_t d = 0; d < 3 && used[node] != 0; ++d) {
                if ((body.fixed[node] >> d & 1) == 0)
                    unknown[d][node] = static_cast<std::int32_t>(unknowns++);
            }
        }
    }

    /// Returns the lower half of the stiffness.
    SparseMatrix assembled(const ElasticBody<3>& body, std::span<const double> moduli) const {
        constexpr std::size_t n = GridElement<3>::unknowns;
        const auto corners = body.grid.corner_steps();
        std::vector<Eigen::Triplet<double>> entries;
        for (std::size_t e = 0; e < body.present.size(); ++e) {
            if (body.present[e] == 0) continue;
            std::array<std::int32_t, n> places{};
            for (std::size_t i = 0; i < n; ++i) {
                const std::ptrdiff_t node = static_cast<std::ptrdiff_t>(e) + corners[i / 3];
                places[i] = unknown[i % 3][static_cast<std::size_t>(node)];
            }
            for (std::size_t i = 0; i < n; ++i) {
                for (std::size_t j = 0; j < n; ++j) {
                    if (places[j] >= 0 && places[i] >= places[j])
                        entries.emplace_back(places[i], places[j], moduli[e] * body.element.stiffness[i][j]);
                }
            }
        }
        SparseMatrix stiffness(unknowns, unknowns);
        stiffness.setFromTriplets(entries.begin(), entries.end());
        return stiffness;
    }
};

DirectSolver::DirectSolver(std::unique_ptr<Factor> factor) : factor_(std::move(factor)) {}

std::unique_ptr<DirectSolver> DirectSolver::make(const ElasticBody<3>& body, std::span<const double> moduli,
                                                 double most) {
    auto factor = std::make_unique<Factor>();
    factor->number(body);
    const Factor::SparseMatrix stiffness = factor->assembled(body, moduli);
    factor->matrix.analyzePattern(stiffness);
    if (factor->matrix.work() > most) return nullptr;
    factor->matrix.factorize(stiffness);
    if (factor->matrix.info() != Eigen::Success)
        throw InputError("a part of an elastic body can move freely; expected one that is held");
    return std::unique_ptr<DirectSolver>(new DirectSolver(std::move(factor)));
}

DirectSolver::~DirectSolver() = default;

NodalVector<3, double> DirectSolver::solve(const NodalVector<3, double>& forces) const {
    Eigen::VectorXd right(factor_->unknowns);
    for (std::size_t d = 0; d < 3; ++d) {
        for (std::size_t node = 0; node < factor_->nodes; ++node) {
            if (const std::int32_t place = factor_->unknown[d][node]; place >= 0)
                right[place] = forces.along[d][node];
        }
    }
    const Eigen::VectorXd moved = factor_->matrix.solve(right);
    NodalVector<3, double> displacements(factor_->nodes);
    for (std::size_t d = 0; d < 3; ++d) {
        for (std::size_t node = 0; node < factor_->nodes; ++node) {
            if (const std::int32_t place = factor_->unknown[d][node]; place >= 0)
                displacements.along[d][node] = moved[place];
        }
    }
    return displacements;
}

}  // namespace lamella
