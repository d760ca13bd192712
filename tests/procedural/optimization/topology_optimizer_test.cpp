// Optimisations of small bodies: symmetry, bounds, prescribed elements, resumption and mistakes.
#include "procedural/optimization/topology_optimizer.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "engine/base/error.h"
#include "tests/procedural/optimization/topology_problems.h"

namespace topology_optimizer_test {

using namespace lamella;
using Role = DensityMap::Role;

namespace {

template <std::size_t Dim>
std::vector<double> result_of(TopologyOptimizer<Dim>& optimizer) {
    while (!optimizer.is_finished()) optimizer.iterate();
    optimizer.analyse();
    const std::span<const double> density = optimizer.densities().density(Role::result);
    return {density.begin(), density.end()};
}

template <std::size_t Dim>
std::vector<double> result_of(const TopologyProblem<Dim>& problem, const TopologySettings& settings) {
    TopologyOptimizer<Dim> optimizer(problem, settings);
    return result_of(optimizer);
}

TopologySettings some_loops(int iterations) {
    TopologySettings settings;
    settings.iterations = iterations;
    settings.tolerance = 0;
    settings.solver_tolerance = 1e-9;
    settings.oc_tolerance = 1e-8;
    return settings;
}

double mean_of(const std::vector<double>& values) {
    double sum = 0;
    for (const double v : values) sum += v;
    return sum / static_cast<double>(values.size());
}

double most_difference(const std::vector<double>& a, const std::vector<double>& b) {
    REQUIRE(a.size() == b.size());
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
    return most;
}

/// Flips a field in the plane: y becomes ny - 1 - y.
std::vector<double> flipped(const std::vector<double>& values, int nx, int ny) {
    std::vector<double> out(values.size());
    for (int y = 0; y < ny; ++y) {
        for (int x = 0; x < nx; ++x)
            out[static_cast<std::size_t>(x + nx * (ny - 1 - y))] =
                values[static_cast<std::size_t>(x + nx * y)];
    }
    return out;
}

/// Cancels in the midst of an analysis: when a case is solved, and the next one is not.
class CancelBetweenCases final : public SharedSolves {
  public:
    explicit CancelBetweenCases(CancelToken& token) : token_(token) {}
    bool is_solved_here(std::size_t) const override { return true; }
    void give(const SolvedCase&) override {
        if (cancels) token_.cancel();
    }
    SolvedCase take(std::size_t, std::uint64_t) override { throw FaultError("all cases are solved here"); }
    bool cancels = false;

  private:
    CancelToken& token_;
};

}  // namespace

TEST_CASE("a cantilever with its load in the middle becomes symmetric by itself", "[optimization]") {
    const TopologyProblem<2> problem = plane_cantilever(24, 12, 0.4, 6);
    const std::vector<double> found = result_of(problem, some_loops(10));
    CHECK(most_difference(found, flipped(found, 24, 12)) < 1e-5);
    CHECK(*std::max_element(found.begin(), found.end()) > 0.95);
}

TEST_CASE("symmetry that is asked for holds to the last bit under any load", "[optimization]") {
    const TopologyProblem<2> problem = plane_cantilever(24, 12, 0.4, 1);
    TopologySettings settings = some_loops(10);
    settings.density.mirrored = {false, true, false};
    for (const TopologyMethod method : {TopologyMethod::oc, TopologyMethod::mma}) {
        settings.method = method;
        const std::vector<double> found = result_of(problem, settings);
        CHECK(most_difference(found, flipped(found, 24, 12)) < 1e-15);
        settings.density.mirrored = {};
        const std::vector<double> other = result_of(problem, settings);
        CHECK(most_difference(other, flipped(other, 24, 12)) > 0.1);
        settings.density.mirrored = {false, true, false};
    }
}

TEST_CASE("two equal load cases of half the weight are one", "[optimization]") {
    const TopologyProblem<2> one = plane_cantilever(24, 12, 0.4, 0);
    TopologyProblem<2> two = one;
    two.cases.push_back(two.cases[0]);
    for (auto& load : two.cases) load.weight = 0.5;
    CHECK(most_difference(result_of(one, some_loops(10)), result_of(two, some_loops(10))) < 1e-12);
}

TEST_CASE("mirrored load cases give a mirrored design", "[optimization]") {
    TopologyProblem<2> low = plane_cantilever(24, 12, 0.4, 0), high = plane_cantilever(24, 12, 0.4, 12);
    const std::vector<double> alone = result_of(low, some_loops(10));
    CHECK(most_difference(alone, flipped(result_of(high, some_loops(10)), 24, 12)) < 1e-5);
    low.cases.push_back(high.cases[0]);
    const std::vector<double> both = result_of(low, some_loops(10));
    CHECK(most_difference(both, flipped(both, 24, 12)) < 1e-5);
    CHECK(most_difference(both, alone) > 0.1);
}

TEST_CASE("prescribed elements stay, and the volume counts them", "[optimization]") {
    TopologyProblem<2> problem = plane_cantilever(24, 12, 0.4, 6);
    double all = 0;
    for (int y = 0; y < 12; ++y) {
        for (int x = 0; x < 24; ++x) {
            ElementUse& use = problem.use[static_cast<std::size_t>(x + 24 * y)];
            if (y == 0) use = ElementUse::solid;
            if (x > 8 && x < 12 && y > 4 && y < 8) use = ElementUse::empty;
            if (x > 18 && y > 8) use = ElementUse::outside;
            all += use != ElementUse::outside ? 1 : 0;
        }
    }
    for (int variant = 0; variant < 5; ++variant) {
        CAPTURE(variant);
        TopologySettings settings = some_loops(30);
        settings.density.radius = 2.5;
        if (variant == 1) settings.method = TopologyMethod::mma;
        if (variant == 2) settings.sensitivity_filter = true;
        if (variant == 3) settings.sharpness = 8;
        if (variant == 4) settings.density.overhang = OverhangSettings{.axis = 1};
        TopologyOptimizer<2> optimizer(problem, settings);
        TopologyIteration last;
        while (!optimizer.is_finished()) last = optimizer.iterate();
        std::vector<double> density = optimizer.state().design;
        if (variant != 2) density = result_of(optimizer);
        double sum = 0;
        for (std::size_t i = 0; i < density.size(); ++i) {
            if (problem.use[i] == ElementUse::solid) CHECK(density[i] == 1);
            if (problem.use[i] == ElementUse::empty) CHECK(density[i] == 0);
            if (problem.use[i] == ElementUse::outside) CHECK(density[i] == 0);
            sum += density[i];
        }
        CHECK(sum / all == Approx(0.4).epsilon(0.005));
        CHECK(last.volume == Approx(0.4).epsilon(0.005));
    }
}

TEST_CASE("elements keep to their own limits, and kept ones to their density", "[optimization]") {
    TopologyProblem<2> problem = plane_cantilever(24, 12, 0.3, 6);
    for (int y = 0; y < 12; ++y) {
        for (int x = 0; x < 24; ++x) {
            problem.limits.push_back(x < 12 ? Interval{0.3, 0.6} : Interval{0.05, 0.2});
            if (x < 6 || y > 3) continue;
            problem.use.at(problem.limits.size() - 1) = ElementUse::kept;
            problem.limits.back() = {0.45, 0.45};
        }
    }
    for (int variant = 0; variant < 3; ++variant) {
        CAPTURE(variant);
        TopologySettings settings = some_loops(30);
        settings.density.radius = 2.5;
        if (variant == 1) settings.method = TopologyMethod::mma;
        if (variant == 2) settings.density.mirrored = {true, true, false};
        TopologyOptimizer<2> optimizer(problem, settings);
        const TopologyIteration first = optimizer.iterate();
        CHECK(first.volume == Approx(0.3).epsilon(1e-9));
        const std::vector<double> found = result_of(optimizer);
        CHECK(mean_of(found) == Approx(0.3).epsilon(0.005));
        CHECK(optimizer.analyse().total < 0.97 * first.compliance);
        bool reaches_least = false, reaches_greatest = false;
        for (std::size_t i = 0; i < found.size(); ++i) {
            const Interval& limits = problem.limits[i];
            CHECK(limits.contains(found[i]));
            if (problem.use[i] == ElementUse::kept) CHECK(found[i] == 0.45);
            reaches_least = reaches_least || found[i] < limits.lo + 1e-6;
            reaches_greatest = reaches_greatest || found[i] > limits.hi - 1e-6;
        }
        CHECK((reaches_least && reaches_greatest));
    }
}

TEST_CASE("limits by element that are all alike are those of the problem", "[optimization]") {
    TopologyProblem<2> problem = half_mbb_beam(24, 8, 0.5);
    problem.least_density = 0.2;
    problem.greatest_density = 0.8;
    TopologySettings settings = some_loops(15);
    settings.density.radius = 2;
    const std::vector<double> of_all = result_of(problem, settings);
    problem.limits.assign(problem.use.size(), {0.2, 0.8});
    CHECK(most_difference(result_of(problem, settings), of_all) < 1e-4);
}

TEST_CASE("what touches a solid element can become solid", "[optimization]") {
    // A bar in tension, solid at its upper side: the best place of more material is anywhere along it.
    TopologyProblem<2> problem = plane_cantilever(30, 6, 0.9, 3);
    for (int x = 0; x < 30; ++x) problem.use[static_cast<std::size_t>(x + 30 * 5)] = ElementUse::solid;
    TopologySettings settings = some_loops(40);
    settings.density.radius = 3;
    const std::vector<double> found = result_of(problem, settings);
    CHECK(found[4 * 30 + 3] > 0.99);
}

TEST_CASE("the volume is met within half a percent, whatever lies in between", "[optimization]") {
    for (int variant = 0; variant < 6; ++variant) {
        CAPTURE(variant);
        TopologyProblem<2> problem = half_mbb_beam(36, 12, 0.5);
        TopologySettings settings;
        settings.iterations = 60;
        settings.density.radius = 2;
        if (variant == 1) settings.sharpness = 16;
        if (variant == 2) settings.method = TopologyMethod::mma;
        if (variant == 3) settings.density.overhang = OverhangSettings{.axis = 1};
        if (variant == 4) {
            settings.density.length_scale = LengthScale{.radius = 3};
            settings.density.padding = FilterPadding::mirror;
            settings.sharpness = 8;
            settings.method = TopologyMethod::mma;
        }
        if (variant == 5) {
            problem.least_density = 0.2;
            problem.greatest_density = 0.8;
        }
        const std::vector<double> found = result_of(problem, settings);
        CHECK(mean_of(found) == Approx(0.5).epsilon(0.005));
        if (variant == 5) {
            CHECK(*std::min_element(found.begin(), found.end()) >= 0.2 - 1e-12);
            CHECK(*std::max_element(found.begin(), found.end()) <= 0.8 + 1e-12);
        }
    }
}

TEST_CASE("a sharp projection leaves little grey", "[optimization]") {
    const TopologyProblem<2> problem = half_mbb_beam(36, 12, 0.5);
    TopologySettings settings;
    settings.density.radius = 2;
    settings.iterations = 120;
    TopologyOptimizer<2> soft(problem, settings);
    TopologyIteration grey, sharp;
    while (!soft.is_finished()) grey = soft.iterate();
    settings.sharpness = 32;
    TopologyOptimizer<2> projected(problem, settings);
    while (!projected.is_finished()) sharp = projected.iterate();
    CHECK(sharp.sharpness == 32);
    CHECK(sharp.greyness < 0.3 * grey.greyness);
    CHECK(sharp.compliance < grey.compliance);
}

TEST_CASE("an optimisation that was saved goes on to the same bits", "[optimization]") {
    for (int variant = 0; variant < 6; ++variant) {
        CAPTURE(variant);
        TopologyProblem<2> problem = half_mbb_beam(36, 12, 0.5);
        TopologySettings settings;
        settings.iterations = 45;
        if (variant % 2 == 1) settings.method = TopologyMethod::mma;
        if (variant >= 2) {
            settings.sharpness = 4;
            problem.cases.push_back(problem.cases[0]);
            problem.cases[1].forces.along[1][problem.body.grid.number(9, 0, 0)] = 0.7;
        }
        if (variant >= 4) settings.compliance = 400;
        TopologyOptimizer<2> whole(problem, settings);
        for (int i = 0; i < 20; ++i) whole.iterate();
        const TopologyState saved = whole.state();
        TopologyOptimizer<2> rest(problem, settings);
        rest.set_state(saved);
        while (!whole.is_finished()) whole.iterate();
        while (!rest.is_finished()) {
            rest.iterate();
            if (rest.state().iteration % 5 == 0) rest.analyse();  // which is to change nothing
        }
        CHECK(rest.state().iteration == whole.state().iteration);
        CHECK(rest.state().design == whole.state().design);
        CHECK(rest.state().displacements == whole.state().displacements);
        // One that had ended does not begin anew.
        TopologyOptimizer<2> ended(problem, settings);
        ended.set_state(whole.state());
        CHECK(ended.is_finished());
    }
}

TEST_CASE("an iteration that is broken off leaves the state as it was", "[optimization]") {
    CancelToken token;
    TopologyProblem<2> problem = half_mbb_beam(36, 12, 0.5);
    problem.cases.push_back(problem.cases[0]);
    problem.cases[1].forces.along[1][problem.body.grid.number(9, 0, 0)] = 0.7;
    TopologySettings settings = some_loops(12);
    settings.solver_tolerance = 1e-3;
    const std::vector<double> expected = result_of(problem, settings);

    CancelBetweenCases between(token);
    settings.cancel = &token;
    settings.shared = &between;
    TopologyOptimizer<2> broken(problem, settings);
    for (int i = 0; i < 5; ++i) broken.iterate();
    const TopologyState before = broken.state();
    between.cancels = true;
    CHECK_THROWS_AS(broken.iterate(), Interrupted);
    CHECK(broken.state().design == before.design);
    CHECK(broken.state().displacements == before.displacements);
    settings.cancel = nullptr;
    settings.shared = nullptr;
    TopologyOptimizer<2> resumed(problem, settings);
    resumed.set_state(broken.state());
    CHECK(result_of(resumed) == expected);
}

TEST_CASE("a state of another problem is refused", "[optimization]") {
    const TopologyProblem<2> problem = half_mbb_beam(36, 12, 0.5), other = half_mbb_beam(30, 12, 0.5);
    TopologyOptimizer<2> a(problem, {}), b(other, {});
    a.iterate();
    CHECK_THROWS_AS(b.set_state(a.state()), InputError);
    TopologyState projected = a.state();
    projected.phase = 1;
    CHECK_THROWS_AS(a.set_state(projected), InputError);
}

TEST_CASE("optimisations have the same bits on any number of threads", "[optimization]") {
    TopologyProblem<2> plane = half_mbb_beam(120, 60, 0.5);
    plane.weight[1] = 1e-4;
    TopologyProblem<3> solid = solid_cantilever(20, 10, 10, 0.2, 1e-6);
    TopologySettings flat = some_loops(6), deep = some_loops(5);
    flat.solver_tolerance = deep.solver_tolerance = 1e-5;
    flat.method = TopologyMethod::mma;
    flat.density.length_scale = LengthScale{.radius = 4};
    flat.sharpness = 4;
    deep.density.overhang = OverhangSettings{.axis = 2};
    deep.density.mirrored[1] = true;
    const std::vector<double> expected_flat = result_of(plane, flat), expected_deep = result_of(solid, deep);
    for (const int threads : {1, 2, 4}) {
        CAPTURE(threads);
        ThreadArena arena(threads);
        CHECK(arena.execute([&] { return result_of(plane, flat); }) == expected_flat);
        CHECK(arena.execute([&] { return result_of(solid, deep); }) == expected_deep);
    }
}

TEST_CASE("the solver needs few iterations at every loop in space", "[optimization][slow]") {
    TopologyProblem<3> problem = solid_cantilever(64, 32, 32, 0.12, 1e-6);
    TopologySettings settings;
    settings.density.radius = std::sqrt(3.0);
    settings.iterations = 50;
    TopologyOptimizer<3> optimizer(problem, settings);
    while (!optimizer.is_finished()) {
        const TopologyIteration loop = optimizer.iterate();
        CAPTURE(loop.index);
        CHECK(loop.solver_iterations <= 25);
    }
}

TEST_CASE("the solver needs few iterations at every loop in the plane", "[optimization]") {
    TopologyProblem<2> problem = half_mbb_beam(150, 50, 0.5);
    TopologySettings settings;
    settings.density.radius = 6;
    settings.iterations = 100;
    TopologyOptimizer<2> optimizer(problem, settings);
    while (!optimizer.is_finished()) {
        const TopologyIteration loop = optimizer.iterate();
        CAPTURE(loop.index);
        CHECK(loop.solver_iterations <= 25);
    }
}

TEST_CASE("problems that cannot be solved are refused", "[optimization]") {
    const TopologyProblem<2> good = half_mbb_beam(12, 6, 0.5);
    CHECK_NOTHROW(TopologyOptimizer<2>(good, {}));
    TopologyProblem<2> bad = good;
    bad.use[7] = ElementUse::kept;
    CHECK_THROWS_WITH(TopologyOptimizer<2>(bad, {}), Catch::Contains("kept elements need a density"));
    bad.limits.assign(bad.use.size() - 1, {0.2, 0.4});
    CHECK_THROWS_AS(TopologyOptimizer<2>(bad, {}), InputError);
    bad.limits.assign(bad.use.size(), {0.5, 0.8});
    CHECK_THROWS_WITH(TopologyOptimizer<2>(bad, {}), Catch::Contains("the volume may be"));
    bad = good;
    std::ranges::fill(bad.use, ElementUse::solid);
    CHECK_THROWS_WITH(TopologyOptimizer<2>(bad, {}), Catch::Contains("no free element"));
    bad.use[0] = ElementUse::free;
    CHECK_THROWS_WITH(TopologyOptimizer<2>(bad, {}), Catch::Contains("solid"));
    bad = good;
    bad.cases.clear();
    CHECK_THROWS_WITH(TopologyOptimizer<2>(bad, {}), Catch::Contains("no load case"));
    bad = good;
    bad.use.pop_back();
    CHECK_THROWS_AS(TopologyOptimizer<2>(bad, {}), InputError);
    bad = good;
    std::ranges::fill(bad.body.fixed, std::uint8_t{0});
    CHECK_THROWS_WITH(TopologyOptimizer<2>(bad, {}), Catch::Contains("not held"));
    TopologySettings settings;
    settings.sensitivity_filter = true;
    settings.sharpness = 4;
    CHECK_THROWS_AS(TopologyOptimizer<2>(good, settings), InputError);
    settings.sharpness = 0;
    settings.density.mirrored[0] = true;
    CHECK_THROWS_AS(TopologyOptimizer<2>(good, settings), InputError);
}

}  // namespace topology_optimizer_test
