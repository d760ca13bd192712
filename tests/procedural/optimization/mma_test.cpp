// The method of moving asymptotes on published problems, and on a quadratic whose optimum is known.
#include "procedural/optimization/mma.h"

#include <catch2/catch.hpp>
#include <limits>
#include <random>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "tests/procedural/optimization/mma_problems.h"

namespace mma_test {

using namespace lamella;
using namespace lamella::mma_problems;

namespace {

constexpr double four_decimals = 0.5001e-4;  // published numbers are rounded to four decimals

struct Run {
    Numbers objectives;  ///< at the first x and after each step
    std::vector<MmaSolution> steps;
    double residual = 0;  ///< of the last

    const Numbers& x() const { return steps.back().x; }
};

Run run_of(const Problem& problem, int steps) {
    Run run;
    Mma mma(problem.first.size(), problem.values(problem.first).constraints.size(), problem.options);
    Numbers x = problem.first;
    run.objectives.push_back(problem.values(x).objective);
    for (int step = 0; step < steps; ++step) {
        run.steps.push_back(
            with_point(problem, x, [&](const MmaPoint& at, double) { return mma.update(at); }));
        x = run.x();
        run.objectives.push_back(problem.values(x).objective);
    }
    const MmaSolution& last = run.steps.back();
    run.residual = kkt_residual(problem, x, last.lambda, last.y, last.z);
    return run;
}

void check_digits(const Numbers& found, const Numbers& wanted) {
    REQUIRE(found.size() >= wanted.size());
    for (std::size_t k = 0; k < wanted.size(); ++k) {
        CAPTURE(k, found[k], wanted[k]);
        CHECK(std::abs(found[k] - wanted[k]) <= four_decimals);
    }
}

std::string message_of(const std::function<void()>& work) {
    try {
        work();
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

/// Minimise the mean of weight (x - wish)^2 in [0, 1] with a mean of size x of at most share times that of
/// size.
struct Quadratic {
    Numbers wish, weight, size, lower, upper;
    double share = 0.4;

    Quadratic(std::size_t n, unsigned seed) : lower(n, 0), upper(n, 1) {
        std::mt19937 random(seed);
        const auto draw = [&](double low, double high) {
            return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
        };
        for (std::size_t j = 0; j < n; ++j) {
            wish.push_back(draw(-0.2, 1.4));
            weight.push_back(draw(1, 10));
            size.push_back(draw(0.5, 2));
        }
    }
    double volume(const Numbers& x) const {
        double sum = 0, whole = 0;
        for (std::size_t j = 0; j < x.size(); ++j) sum += size[j] * x[j], whole += size[j];
        return sum / (share * whole) - 1;
    }
    /// The optimum, by bisection on the multiplier of `sum size x`.
    Numbers optimum() const {
        Numbers x(wish.size());
        double low = 0, high = 100;
        while (true) {
            const double middle = 0.5 * (low + high);
            if (middle <= low || middle >= high) return x;
            for (std::size_t j = 0; j < x.size(); ++j)
                x[j] = std::clamp(wish[j] - middle * size[j] / (2 * weight[j]), 0.0, 1.0);
            (volume(x) > 0 ? low : high) = middle;
        }
    }
    std::vector<MmaSolution> run(int steps, int threads, const Numbers& first) const {
        const std::size_t n = wish.size();
        Mma mma(n, 1, {.move = 0.2});
        std::vector<MmaSolution> done;
        Numbers x = first, objective(n), row(n);
        const double whole = (volume(Numbers(n, 1)) + 1);
        double sizes = 0;
        for (const double s : size) sizes += s;
        for (std::size_t j = 0; j < n; ++j) row[j] = 10 * whole * size[j] / sizes;
        ThreadArena arena(threads);
        for (int step = 0; step < steps; ++step) {
            for (std::size_t j = 0; j < n; ++j)
                objective[j] = 20 * weight[j] * (x[j] - wish[j]) / static_cast<double>(n);
            const Numbers constraint{10 * volume(x)};
            done.push_back(arena.execute([&] {
                return mma.update({x, lower, upper, objective, constraint, {row}});
            }));
            x = done.back().x;
        }
        return done;
    }
};

}  // namespace

TEST_CASE("Svanberg's beam has the published iterates and the closed-form optimum", "[optimization]") {
    const Run run = run_of(beam(), 5);
    check_digits(run.objectives, {1.5600, 1.2759, 1.3269, 1.3361, 1.3396, 1.3400});
    check_digits(run.steps[0].x, {5.6966, 5.1410, 4.3965, 3.3533, 1.8596});

    const Run longer = run_of(beam(), 20);
    check_digits(longer.x(), {6.0160, 5.3092, 4.4943, 3.5015, 2.1527});
    const Numbers optimum = beam_optimum();
    for (std::size_t j = 0; j < 5; ++j) CHECK(longer.x()[j] == Approx(optimum[j]).epsilon(1e-6));
    double roots = 0;
    for (const double a : {61.0, 37.0, 19.0, 7.0, 1.0}) roots += std::pow(a, 0.25);
    CHECK(longer.objectives.back() == Approx(0.0624 * std::pow(roots, 4.0 / 3)).epsilon(1e-8));
    CHECK(longer.residual < 1e-7);
}

TEST_CASE("the point in two balls has the published iterates", "[optimization]") {
    const Run run = run_of(two_balls(), 4);
    check_digits(run.objectives, {29, 9.9599, 8.8030, 8.7703, 8.7702});
    const Run longer = run_of(two_balls(), 20);
    check_digits(longer.x(), {2.0175, 1.7800, 1.2375});
    CHECK(longer.residual < 1e-6);
}

TEST_CASE("three bars under three loads are published to become equally stiff", "[optimization]") {
    const Run run = run_of(three_bars(), 6);
    check_digits(run.steps[0].x, {0.9034, 1.1619, 0.9034});
    check_digits(run.x(), {0.7500, 1.5000, 0.7500});
    CHECK(std::abs(run.steps.back().z - 0.8889) <= four_decimals);
    const Run longer = run_of(three_bars(), 20);
    CHECK(longer.steps.back().z ==
          Approx(8.0 / 9).epsilon(1e-8));  // by hand, with all three compliances equal
    CHECK(longer.residual < 1e-6);
}

TEST_CASE("a hundred thousand variables reach their optimum with equal bits on any number of threads",
          "[optimization]") {
    const std::size_t n = 100000;
    const Quadratic problem(n, 7);
    const Numbers first(n, 0.4), optimum = problem.optimum();
    const int steps = 40;
    const std::vector<MmaSolution> one = problem.run(steps, 1, first);
    for (const int threads : {2, 4}) {
        const std::vector<MmaSolution> many = problem.run(12, threads, first);
        for (std::size_t step = 0; step < many.size(); ++step) {
            REQUIRE(many[step].x == one[step].x);
            REQUIRE(many[step].lambda == one[step].lambda);
            REQUIRE(many[step].y == one[step].y);
        }
    }
    double worst = 0;
    for (std::size_t j = 0; j < n; ++j) worst = std::max(worst, std::abs(one.back().x[j] - optimum[j]));
    CHECK(worst < 1e-6);
    CHECK(std::abs(problem.volume(one.back().x)) < 1e-6);
}

TEST_CASE("an infeasible start comes back to the feasible side, with y for what is missing",
          "[optimization]") {
    const std::size_t n = 1000;
    const Quadratic problem(n, 8);
    const Numbers first(n, 1), optimum = problem.optimum();
    const std::vector<MmaSolution> run = problem.run(40, 1, first);
    // A step of at most 0.2 cannot lose 60 % of the volume.
    CHECK(problem.volume(run[0].x) > 0.5);
    CHECK(run[0].y[0] > 1);
    for (std::size_t j = 0; j < n; ++j) CHECK(run[0].x[j] == Approx(0.8).epsilon(1e-9));
    CHECK(problem.volume(run.back().x) < 1e-6);
    CHECK(run.back().y[0] < 1e-6);
    for (std::size_t j = 0; j < n; ++j) REQUIRE(run.back().x[j] == Approx(optimum[j]).margin(1e-4));
}

TEST_CASE("steps keep bounds, move limit and fixed variables", "[optimization]") {
    const std::size_t n = 500;
    Quadratic problem(n, 9);
    Numbers first(n, 0.3);
    for (std::size_t j = 0; j < n; j += 5)
        first[j] = problem.lower[j] = problem.upper[j] = 0.1 + 0.1 * static_cast<double>(j % 7);
    Numbers x = first;
    std::size_t at_bounds = 0;
    for (const MmaSolution& step : problem.run(20, 1, first)) {
        for (std::size_t j = 0; j < n; ++j) {
            REQUIRE(step.x[j] >= problem.lower[j]);
            REQUIRE(step.x[j] <= problem.upper[j]);
            REQUIRE(std::abs(step.x[j] - x[j]) <= 0.2 + 1e-15);
            at_bounds += step.x[j] == 0 || step.x[j] == 1 ? 1 : 0;
        }
        x = step.x;
    }
    CHECK(at_bounds > 0);
}

TEST_CASE("a run goes on from its saved state with the same bits", "[optimization]") {
    const Problem problem = beam();
    const Run whole = run_of(problem, 6);
    const auto step = [&](Mma& mma, const Numbers& x) {
        return with_point(problem, x, [&](const MmaPoint& at, double) { return mma.update(at).x; });
    };
    Mma first(5, 1);
    Numbers x = problem.first;
    for (int k = 0; k < 3; ++k) x = step(first, x);
    const MmaState state = first.state();
    CHECK(state.steps == 3);
    CHECK(state.former == whole.steps[1].x);
    CHECK(state.before == whole.steps[0].x);
    Mma second(5, 1);
    second.set_state(state);
    for (int k = 3; k < 6; ++k) {
        x = step(second, x);
        CHECK(x == whole.steps[static_cast<std::size_t>(k)].x);
    }
}

TEST_CASE("after a reset the asymptotes are those of a first step", "[optimization]") {
    const Problem problem = beam();
    Mma mma(5, 1);
    Numbers x = problem.first;
    const auto step = [&](Mma& by) {
        return with_point(problem, x, [&](const MmaPoint& at, double) { return by.update(at).x; });
    };
    for (int k = 0; k < 5; ++k) x = step(mma);
    Mma fresh(5, 1), kept(5, 1);
    kept.set_state(mma.state());
    mma.reset_asymptotes();
    CHECK(mma.state().steps == 0);
    const Numbers reset = step(mma);
    CHECK(reset == step(fresh));
    CHECK(reset != step(kept));
    for (std::size_t j = 0; j < 5; ++j) {
        CHECK(mma.state().asymptotes.low[j] == x[j] - 4.5);
        CHECK(mma.state().asymptotes.upp[j] == x[j] + 4.5);
    }
}

TEST_CASE("asymptotes widen along a direction, narrow at a swing and stay within 0.01 and 10 ranges",
          "[optimization]") {
    // variables: keeps its direction, swings, rests, is far, is near
    const Numbers x{0.4, 0.3, 0.3, 0.3, 0.3}, lower(5, 0), upper(5, 1), none(5, 0);
    MmaState state;
    state.steps = 2;
    state.before = {0.2, 0.2, 0.2, 0.1, 0.2999};
    state.former = {0.3, 0.4, 0.3, 0.2, 0.3001};
    state.asymptotes.low = {0.2, 0.1, 0.1, -9.5, 0.2901};
    state.asymptotes.upp = {0.5, 0.8, 0.4, 9.7, 0.3101};
    const MmaAsymptotes to = moved_asymptotes(state, {x, lower, upper, none, {}, {}}, {});
    const Numbers low{0.4 - 1.2 * 0.1, 0.3 - 0.7 * 0.3, 0.3 - 0.2, 0.3 - 10, 0.3 - 0.01};
    const Numbers upp{0.4 + 1.2 * 0.2, 0.3 + 0.7 * 0.4, 0.3 + 0.1, 0.3 + 10, 0.3 + 0.01};
    for (std::size_t j = 0; j < 5; ++j) {
        CHECK(to.low[j] == Approx(low[j]).epsilon(1e-12));
        CHECK(to.upp[j] == Approx(upp[j]).epsilon(1e-12));
    }
}

TEST_CASE("without constraints a step goes to the minimum of the approximation", "[optimization]") {
    Problem problem{{}, {0, 0}, {1, 1}, {0.5, 0.5}, {}, {}};
    problem.values = [](std::span<const double> x) { return MmaValues{0.002 * x[0] - 5 * x[1], {}}; };
    problem.gradients = [](std::span<const double>) { return std::vector<Numbers>{{0.002, -5}}; };
    problem.options.raa = 0.004;
    const Run run = run_of(problem, 1);
    // With asymptotes 0 and 1: p = 0.25 (0.002 + e), q = 0.25 e, e = 0.001 * 0.002 + 0.004.
    const double ratio = std::sqrt((0.002 + 0.004002) / 0.004002);
    CHECK(run.x()[0] == Approx(1 / (1 + ratio)).epsilon(1e-12));
    CHECK(run.x()[1] == Approx(0.95).epsilon(1e-12));  // a tenth of the way is left to the asymptote
    CHECK(run_of(problem, 10).x()[1] == 1);
}

TEST_CASE("what does not fit is an error and leaves the state as it was", "[optimization]") {
    CHECK_THROWS_AS(Mma(0, 1), InputError);
    CHECK_THROWS_AS(Mma(5, max_mma_constraints + 1), InputError);
    CHECK_THROWS_AS(Mma(5, 2, {.c = {1000}}), InputError);
    CHECK_THROWS_AS(Mma(5, 1, {.c = {0}, .d = {0}}), InputError);
    CHECK_THROWS_AS(Mma(5, 1, {.move = 0}), InputError);
    CHECK_THROWS_AS(Mma(5, 1, {.a0 = 0}), InputError);
    CHECK_THROWS_AS(Mma(5, 1, {.raa = -1}), InputError);

    Mma mma(3, 1);
    const Numbers x{0.1, 0.2, 0.3}, lower(3, 0), upper(3, 1), slopes(3, 1), value{1}, two{1, 1}, few(2, 0);
    const auto is_refused = [&](const MmaPoint& point) {
        return !message_of([&] { mma.update(point); }).empty();
    };
    mma.update({x, lower, upper, slopes, value, {slopes}});
    CHECK(is_refused({few, lower, upper, slopes, value, {slopes}}));
    CHECK(is_refused({x, few, upper, slopes, value, {slopes}}));
    CHECK(is_refused({x, lower, few, slopes, value, {slopes}}));
    CHECK(is_refused({x, lower, upper, few, value, {slopes}}));
    CHECK(is_refused({x, lower, upper, slopes, two, {slopes}}));
    CHECK(is_refused({x, lower, upper, slopes, value, {}}));
    CHECK(is_refused({x, lower, upper, slopes, value, {few}}));
    const Numbers outside{0.1, 1.5, 0.3};
    CHECK(message_of([&] {
              mma.update({outside, lower, upper, slopes, value, {slopes}});
          }) == "moving asymptotes: variable 2 is 1.500000; its bounds are 0.000000 and 1.000000");
    const Numbers unknown{0.1, std::numeric_limits<double>::quiet_NaN(), 0.3};
    CHECK_THROWS_AS(mma.update({x, lower, upper, slopes, value, {unknown}}), FaultError);
    CHECK_THROWS_AS(mma.update({x, lower, upper, unknown, value, {slopes}}), FaultError);
    CHECK(mma.state().steps == 1);
    CHECK(mma.state().former == x);

    MmaState state = mma.state();
    CHECK(message_of([&] { mma.set_state(state); }).empty());
    CHECK_THROWS_AS(Mma(4, 1).set_state(state), InputError);
    state.steps = 2;
    CHECK_THROWS_AS(mma.set_state(state), InputError);
    state.before = {0.1, 0.2, 0.3};
    mma.set_state(state);
    state.asymptotes.low[1] = 0.9;
    CHECK_THROWS_AS(mma.set_state(state), InputError);
}

}  // namespace mma_test
