// The direct solver against a dense one.
#include "procedural/elasticity/direct_solver.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "engine/base/error.h"
#include "tests/procedural/elasticity/dense_body.h"

namespace direct_solver_test {

using namespace lamella;

namespace {

constexpr double any_work = 1e12;

/// A bar with a hole, moduli over three decades, and some nodes held.
struct Bar {
    ElasticBody<3> body{NodeGrid<3>({6, 4, 3}), make_solid_element({1, 0.3}, {1, 0.8, 1.2})};
    std::vector<double> moduli = std::vector<double>(body.grid.size());
    NodalVector<3, double> forces{body.grid.size()};

    Bar() {
        std::mt19937 random(7);
        std::uniform_real_distribution<double> share(0, 1);
        for_each_place({6, 4, 3}, [&](glm::ivec3 at) {
            const std::size_t e = body.grid.number(at.x, at.y, at.z);
            if (at.x == 3 && at.y > 0 && at.y < 3) body.present[e] = 0;
            if (body.present[e] != 0) moduli[e] = std::pow(10.0, -3 * share(random));
        });
        for_each_place(body.grid.nodes(), [&](glm::ivec3 at) {
            const std::size_t node = body.grid.number(at.x, at.y, at.z);
            if (at.x == 0) body.fixed[node] = at.y == 0 ? 7 : 1;
            for (auto& along : forces.along) along[node] = share(random) - 0.5;
        });
    }
};

}  // namespace

TEST_CASE("a direct solver finds the displacements of a dense one", "[elasticity]") {
    const Bar bar;
    const auto solver = DirectSolver::make(bar.body, bar.moduli, any_work);
    REQUIRE(solver);
    const NodalVector<3, double> u = solver->solve(bar.forces);
    const Eigen::MatrixXd all = dense_stiffness(bar.body, bar.moduli);
    const std::vector<bool> moves = dense_free(bar.body);
    std::vector<Eigen::Index> rows;
    for (Eigen::Index row = 0; row < all.rows(); ++row)
        if (moves[static_cast<std::size_t>(row)] && all(row, row) > 0) rows.push_back(row);
    Eigen::VectorXd forces(all.rows()), found(all.rows());
    for_each_place(bar.body.grid.nodes(), [&](glm::ivec3 at) {
        const std::size_t node = bar.body.grid.number(at.x, at.y, at.z);
        for (std::size_t d = 0; d < 3; ++d) {
            const Eigen::Index row = 3 * dense_node(bar.body.grid, at) + static_cast<Eigen::Index>(d);
            forces[row] = bar.forces.along[d][node];
            found[row] = u.along[d][node];
            if (!moves[static_cast<std::size_t>(row)]) CHECK(found[row] == 0);
        }
    });
    const Eigen::VectorXd expected = all(rows, rows).ldlt().solve(forces(rows));
    const Eigen::VectorXd here = found(rows);
    CHECK((here - expected).cwiseAbs().maxCoeff() < 1e-9 * expected.cwiseAbs().maxCoeff());
}

TEST_CASE("a direct solver says what is too much for it, and what is loose", "[elasticity]") {
    Bar bar;
    CHECK(DirectSolver::make(bar.body, bar.moduli, 1e4) == nullptr);
    for (std::uint8_t& fixed : bar.body.fixed) fixed &= 1;
    CHECK_THROWS_AS(DirectSolver::make(bar.body, bar.moduli, any_work), InputError);
}

}  // namespace direct_solver_test
