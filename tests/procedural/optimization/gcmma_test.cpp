// The globally convergent method of moving asymptotes: published iterates, and what it promises of each step.
#include "procedural/optimization/gcmma.h"

#include <catch2/catch.hpp>
#include <limits>
#include <random>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "tests/procedural/optimization/mma_problems.h"

namespace gcmma_test {

using namespace lamella;
using namespace lamella::mma_problems;

namespace {

constexpr double four_decimals = 0.5001e-4;  // published numbers are rounded to four decimals

Gcmma method_for(const Problem& problem) {
    return Gcmma(problem.first.size(), problem.values(problem.first).constraints.size(), problem.options);
}

GcmmaStep step_of(Gcmma& gcmma, const Problem& problem, const Numbers& x) {
    return with_point(problem, x, [&](const MmaPoint& at, double objective) {
        return gcmma.update(at, objective, problem.values);
    });
}

std::vector<GcmmaStep> run_of(const Problem& problem, int steps) {
    Gcmma gcmma = method_for(problem);
    std::vector<GcmmaStep> run;
    for (int step = 0; step < steps; ++step)
        run.push_back(step_of(gcmma, problem, run.empty() ? problem.first : run.back().x));
    return run;
}

double residual_of(const Problem& problem, const GcmmaStep& step) {
    return kkt_residual(problem, step.x, step.lambda, step.y, step.z);
}

/// Rosenbrock's valley, which turns, inside a disc of radius 1.2.
Problem valley() {
    Problem problem{{}, {-2, -2}, {2, 2}, {-1, 0.5}, {}, {}};
    problem.values = [](std::span<const double> x) {
        const double side = x[1] - x[0] * x[0], along = 1 - x[0];
        return MmaValues{100 * side * side + along * along, {x[0] * x[0] + x[1] * x[1] - 1.44}};
    };
    problem.gradients = [](std::span<const double> x) {
        const double side = x[1] - x[0] * x[0];
        return std::vector<Numbers>{{-400 * side * x[0] - 2 * (1 - x[0]), 200 * side}, {2 * x[0], 2 * x[1]}};
    };
    return problem;
}

}  // namespace

TEST_CASE("Svanberg's beam has the published iterates and counts of inner iterations", "[optimization]") {
    const Problem problem = beam();
    const std::vector<GcmmaStep> run = run_of(problem, 20);
    const Numbers objectives{1.3886, 1.3504, 1.3409, 1.3401}, first{5.5684, 5.0835, 4.4966, 3.8307, 3.2746};
    const std::vector<int> inner{1, 1, 2, 2};
    for (std::size_t k = 0; k < objectives.size(); ++k) {
        CAPTURE(k, run[k].evaluations, run[k].values.objective);
        CHECK(std::abs(run[k].values.objective - objectives[k]) <= four_decimals);
        CHECK(run[k].evaluations == 1 + inner[k]);  // the first subproblem is no inner iteration
    }
    for (std::size_t j = 0; j < 5; ++j) CHECK(std::abs(run[0].x[j] - first[j]) <= four_decimals);
    double before = problem.values(problem.first).objective;
    for (const GcmmaStep& step : run) {
        CHECK(step.is_conservative);
        CHECK(step.values.constraints[0] <= 1e-7);  // never infeasible
        CHECK(step.values.objective <= before + 1e-7);
        before = step.values.objective;
    }
    const Numbers optimum = beam_optimum();
    for (std::size_t j = 0; j < 5; ++j) CHECK(run.back().x[j] == Approx(optimum[j]).epsilon(1e-5));
    CHECK(residual_of(problem, run.back()) < 1e-6);
}

TEST_CASE("the globally convergent method solves the problems of the other one", "[optimization]") {
    const std::vector<GcmmaStep> balls = run_of(two_balls(), 40), bars = run_of(three_bars(), 40);
    CHECK(std::abs(balls.back().values.objective - 8.7702) <= four_decimals);
    CHECK(residual_of(two_balls(), balls.back()) < 1e-5);
    CHECK(bars.back().z == Approx(8.0 / 9).epsilon(1e-6));
    CHECK(residual_of(three_bars(), bars.back()) < 1e-5);
}

TEST_CASE("each step along a turning valley is feasible and no worse than the one before", "[optimization]") {
    const Problem problem = valley();
    double before = problem.values(problem.first).objective;
    const std::vector<GcmmaStep> run = run_of(problem, 300);
    int repeated = 0;
    for (const GcmmaStep& step : run) {
        REQUIRE(step.is_conservative);
        REQUIRE(step.values.objective <= before + 1e-7 * (1 + before));
        REQUIRE(step.values.constraints[0] <= 1e-6);
        repeated += step.evaluations > 1 ? 1 : 0;
        before = step.values.objective;
    }
    CHECK(repeated > 0);
    // (1, 1) lies outside, so the optimum is the best point of the circle.
    double best = before;
    for (double x = 0; x < 1.2; x += 1e-6) {
        const Numbers at{x, std::sqrt(1.44 - x * x)};
        best = std::min(best, problem.values(at).objective);
    }
    CHECK(before - best < 1e-5);
}

TEST_CASE("without constraints the minimum inside the bounds is found", "[optimization]") {
    Problem problem{{}, {0, 0}, {1, 1}, {0.5, 0.5}, {}, {}};
    problem.values = [](std::span<const double> x) {
        return MmaValues{(x[0] - 0.3) * (x[0] - 0.3) + (x[1] - 2) * (x[1] - 2), {}};
    };
    problem.gradients = [](std::span<const double> x) {
        return std::vector<Numbers>{{2 * (x[0] - 0.3), 2 * (x[1] - 2)}};
    };
    const GcmmaStep last = run_of(problem, 60).back();
    CHECK(last.x[0] == Approx(0.3).margin(1e-4));
    CHECK(last.x[1] == 1);
}

TEST_CASE("where functions are not finite, steps become shorter", "[optimization]") {
    // minus the square root of x - 0.4, which is unknown below 0.4; the slope at 0.5 draws far beyond
    Problem problem{{}, {0}, {1}, {0.5}, {}, {}};
    const double nothing = std::numeric_limits<double>::quiet_NaN();
    problem.values = [=](std::span<const double> x) {
        return MmaValues{x[0] < 0.4 ? nothing : 100 * x[0], {}};
    };
    problem.gradients = [](std::span<const double>) { return std::vector<Numbers>{{100}}; };
    Gcmma gcmma = method_for(problem);
    const GcmmaStep step = step_of(gcmma, problem, problem.first);
    CHECK(step.evaluations > 1);
    CHECK(step.x[0] >= 0.4);
    CHECK(step.x[0] < 0.5);

    problem.values = [=](std::span<const double> x) { return MmaValues{x[0] < 0.5 ? nothing : 50, {}}; };
    const MmaState state = gcmma.state();
    const auto fail = [&] {
        const Numbers x{0.5}, lower{0}, upper{1}, slope{100};
        gcmma.update({x, lower, upper, slope, {}, {}}, 50, problem.values);
    };
    CHECK_THROWS_AS(fail(), FaultError);
    CHECK(gcmma.state().steps == state.steps);
    CHECK(gcmma.state().former == state.former);
}

TEST_CASE("a globally convergent run goes on from its saved state with the same bits", "[optimization]") {
    const Problem problem = valley();
    const std::vector<GcmmaStep> whole = run_of(problem, 8);
    Gcmma first = method_for(problem), second = method_for(problem);
    Numbers x = problem.first;
    for (int k = 0; k < 4; ++k) x = step_of(first, problem, x).x;
    second.set_state(first.state());
    for (std::size_t k = 4; k < 8; ++k) {
        x = step_of(second, problem, x).x;
        CHECK(x == whole[k].x);
    }
    second.reset_asymptotes();
    CHECK(second.state().steps == 0);
    CHECK_THROWS_AS(Gcmma(3, 1).set_state(first.state()), InputError);
}

TEST_CASE("globally convergent steps have equal bits on any number of threads", "[optimization]") {
    const std::size_t n = 20000;
    std::mt19937 random(11);
    Numbers wish(n);
    for (double& v : wish) v = static_cast<double>(random()) / 4294967296.0;
    const double share = 1 / static_cast<double>(n);
    Problem problem{{}, Numbers(n, 0), Numbers(n, 1), Numbers(n, 0.3), {}, {}};
    problem.values = [&](std::span<const double> x) {
        MmaValues at{0, {-3}};
        for (std::size_t j = 0; j < n; ++j) {
            at.objective += 100 * share * (x[j] - wish[j]) * (x[j] - wish[j]);
            at.constraints[0] += 10 * share * x[j];
        }
        return at;
    };
    problem.gradients = [&](std::span<const double> x) {
        std::vector<Numbers> rows{Numbers(n), Numbers(n, 10 * share)};
        for (std::size_t j = 0; j < n; ++j) rows[0][j] = 200 * share * (x[j] - wish[j]);
        return rows;
    };
    std::vector<GcmmaStep> one;
    for (const int threads : {1, 2, 4}) {
        ThreadArena arena(threads);
        const std::vector<GcmmaStep> run = arena.execute([&] { return run_of(problem, 6); });
        if (one.empty()) one = run;
        for (std::size_t k = 0; k < run.size(); ++k) {
            REQUIRE(run[k].x == one[k].x);
            REQUIRE(run[k].lambda == one[k].lambda);
            REQUIRE(run[k].evaluations == one[k].evaluations);
        }
    }
}

TEST_CASE("values that do not fit are an error", "[optimization]") {
    Problem problem = beam();
    problem.values = [](std::span<const double>) { return MmaValues{1, {0, 0}}; };
    Gcmma gcmma(5, 1);
    const Numbers x(5, 5), lower(5, 1), upper(5, 10), slope(5, 1), value{0};
    const MmaPoint point{x, lower, upper, slope, value, {slope}};
    CHECK_THROWS_AS(gcmma.update(point, 1, problem.values), InputError);
    CHECK_THROWS_AS(gcmma.update(point, std::numeric_limits<double>::infinity(), beam().values), FaultError);
    CHECK_THROWS_AS(gcmma.update({x, lower, upper, value, value, {slope}}, 1, beam().values), InputError);
    CHECK(gcmma.state().steps == 0);
}

}  // namespace gcmma_test
