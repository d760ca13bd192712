// Optimality criteria against problems whose optimum is known.
#include "procedural/optimization/oc_update.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "engine/base/parallel.h"

namespace oc_update_test {

using namespace lamella;

namespace {

/// min sum a_i / x_i at a bounded sum of x_i.
struct Reciprocals {
    std::vector<double> a, x, lower, upper, gradient, ones;

    explicit Reciprocals(std::size_t count)
        : x(count, 0.4), lower(count, 0.0), upper(count, 1.0), ones(count, 1.0) {
        std::mt19937 random(3);
        std::uniform_real_distribution<double> share(0.5, 1.5);
        for (std::size_t i = 0; i < count; ++i) a.push_back(share(random));
    }
    std::vector<double> step(double bound, const OcSettings& settings) {
        gradient.clear();
        double excess = -bound;
        for (std::size_t i = 0; i < x.size(); ++i) {
            gradient.push_back(-a[i] / (x[i] * x[i]));
            excess += x[i];
        }
        return oc_update({.x = x,
                          .lower = lower,
                          .upper = upper,
                          .compliance_gradient = gradient,
                          .volume_gradient = ones,
                          .excess = excess},
                         settings);
    }
};

double sum_of(const std::vector<double>& values) {
    double sum = 0;
    for (const double v : values) sum += v;
    return sum;
}

}  // namespace

TEST_CASE("optimality criteria solve a separable problem in one step", "[optimization]") {
    Reciprocals problem(50);
    const std::vector<double> next = problem.step(20, {.move = 1, .tolerance = 1e-10});
    double roots = 0;
    for (const double a : problem.a) roots += std::sqrt(a);
    for (std::size_t i = 0; i < next.size(); ++i)
        CHECK(next[i] == Approx(20 * std::sqrt(problem.a[i]) / roots).epsilon(1e-8));
}

TEST_CASE("the volume is met with bounds in the way as well", "[optimization]") {
    Reciprocals problem(50);
    for (std::size_t i = 0; i < 50; ++i) {
        problem.lower[i] = i % 5 == 0 ? 0.4 : 0.1;
        problem.upper[i] = i % 3 == 0 ? 0.42 : 0.9;
        if (i % 7 == 0) problem.lower[i] = problem.upper[i] = 0.4;
    }
    const std::vector<double> next = problem.step(18, {.move = 0.15, .tolerance = 1e-10});
    CHECK(sum_of(next) == Approx(18).epsilon(1e-8));
    for (std::size_t i = 0; i < 50; ++i) {
        CHECK(next[i] >= std::max(problem.lower[i], problem.x[i] - 0.15));
        CHECK(next[i] <= std::min(problem.upper[i], problem.x[i] + 0.15));
    }
}

TEST_CASE("variables without volume keep their value", "[optimization]") {
    Reciprocals problem(10);
    problem.ones[4] = 0;
    problem.ones[5] = -1e-3;
    const std::vector<double> next = problem.step(3, {});
    CHECK(next[4] == 0.4);
    CHECK(next[5] == 0.4);
    CHECK(next[3] < 0.4);
}

TEST_CASE("optimality criteria give the same bits on any number of threads", "[optimization]") {
    Reciprocals problem(20000);
    const std::vector<double> expected = problem.step(7000, {});
    for (const int threads : {1, 2, 4})
        CHECK(ThreadArena(threads).execute([&] { return problem.step(7000, {}); }) == expected);
}

}  // namespace oc_update_test
