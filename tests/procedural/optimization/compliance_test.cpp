// The compliance of designs under loads and their own weight, against closed forms.
#include "procedural/optimization/compliance.h"

#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "tests/procedural/optimization/topology_problems.h"

namespace compliance_test {

using namespace lamella;

namespace {

/// A column that hangs from its upper end; no Poisson effect.
template <std::size_t Dim>
TopologyProblem<Dim> hanging_column(int count, double weight) {
    TopologyProblem<Dim> problem = free_box<Dim>({1, count, 1}, 0.5, 1e-9);
    if constexpr (Dim == 2) {
        problem.body.element = make_plane_stress_element({1, 0});
    } else {
        problem.body.element = make_solid_element({1, 0});
    }
    for (int z = 0; z < (Dim == 2 ? 1 : 2); ++z) {
        for (int x = 0; x < 2; ++x)
            problem.body.fixed[problem.body.grid.number(x, count, z)] = (1U << Dim) - 1;
    }
    problem.weight[1] = -weight;
    return problem;
}

template <std::size_t Dim>
double compliance_of(const TopologyProblem<Dim>& problem, double density) {
    Compliance<Dim> compliance(problem, {.tolerance = 1e-12});
    return compliance.evaluate(std::vector<double>(problem.use.size(), density)).total;
}

}  // namespace

TEST_CASE("a bar that hangs stretches under its own weight", "[optimization]") {
    // w^2 (n^3 / 3 - n / 12): element k from below carries k - 1/2 weights.
    CHECK(compliance_of(hanging_column<2>(10, 1), 1) == Approx(332.5).epsilon(1e-9));
    CHECK(compliance_of(hanging_column<3>(10, 1), 1) == Approx(332.5).epsilon(1e-9));
    CHECK(compliance_of(hanging_column<2>(10, 0.2), 1) == Approx(332.5 * 0.04).epsilon(1e-9));
    CHECK(compliance_of(hanging_column<2>(7, 1), 1) == Approx(343.0 / 3 - 7.0 / 12).epsilon(1e-9));
    // Half as dense: half as heavy, an eighth as stiff.
    CHECK(compliance_of(hanging_column<3>(10, 1), 0.5) == Approx(332.5 * 0.25 * 8).epsilon(1e-7));
}

TEST_CASE("elements of two laws are springs in a row", "[optimization]") {
    // A column of unit squares that is pulled by 1: each stretches by 1 over its modulus.
    TopologyProblem<2> problem = hanging_column<2>(10, 0);
    for (int x = 0; x < 2; ++x) problem.cases[0].forces.along[1][problem.body.grid.number(x, 0, 0)] = -0.5;
    problem.laws = {make_penalty_law({.exponent = 3, .least = 0}),
                    make_penalty_law({.exponent = 1, .least = 0})};
    problem.law_of = {0, 1, 1, 0, 0, 0, 0, 0, 1, 1};
    CHECK(compliance_of(problem, 0.5) == Approx(6 * 8 + 4 * 2).epsilon(1e-9));
    problem.law_of.pop_back();
    CHECK_THROWS_WITH(compliance_of(problem, 0.5), Catch::Contains("several laws"));
}

TEST_CASE("weight and loads act together, case by case", "[optimization]") {
    TopologyProblem<2> problem = hanging_column<2>(10, 1);
    const NodeGrid<2>& grid = problem.body.grid;
    // As much again at the lower end as the whole bar weighs: element k carries k - 1/2 + 10.
    problem.cases.push_back({"pulled", 0.25, NodalVector<2, double>(grid.size())});
    for (int x = 0; x < 2; ++x) problem.cases[1].forces.along[1][grid.number(x, 0, 0)] = -5;
    Compliance<2> compliance(problem, {.tolerance = 1e-12});
    const Compliance<2>::Result found = compliance.evaluate(std::vector<double>(10, 1.0));
    double pulled = 0;

    for (int k = 1; k <= 10; ++k) pulled += (k - 0.5 + 10) * (k - 0.5 + 10);
    REQUIRE(found.by_case.size() == 2);
    CHECK(found.by_case[0] == Approx(332.5).epsilon(1e-9));
    CHECK(found.by_case[1] == Approx(pulled).epsilon(1e-9));
    CHECK(found.total == Approx(332.5 + 0.25 * pulled).epsilon(1e-9));
}

TEST_CASE("elements outside the body weigh and carry nothing", "[optimization]") {
    TopologyProblem<2> problem = free_box<2>({3, 10, 1}, 0.5, 1e-9);
    problem.body.element = make_plane_stress_element({1, 0});
    for (std::size_t i = 0; i < problem.use.size(); ++i) {
        if (i % 3 != 1) problem.use[i] = ElementUse::outside;
    }
    for (int x = 0; x <= 3; ++x) problem.body.fixed[problem.body.grid.number(x, 10, 0)] = 3;
    problem.weight[1] = -1;
    CHECK(compliance_of(problem, 1) == Approx(332.5).epsilon(1e-9));
}

TEST_CASE("displacements of another problem are refused", "[optimization]") {
    const TopologyProblem<2> problem = hanging_column<2>(10, 1);
    Compliance<2> compliance(problem, {});
    CHECK_THROWS_AS(compliance.set_displacements({{1.0}, {1.0}}), InputError);
    const std::vector<double> along(problem.body.grid.size());
    CHECK_THROWS_AS(compliance.set_displacements({along}), InputError);
    CHECK_THROWS_AS(compliance.set_displacements({along, along, along, along}), InputError);
    CHECK_NOTHROW(compliance.set_displacements({along, along}));
    CHECK_NOTHROW(compliance.set_displacements({}));
}

}  // namespace compliance_test
