// Subproblems of the method of moving asymptotes against their conditions of optimality.
#include "procedural/optimization/mma_subproblem.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

namespace mma_subproblem_test {

using namespace lamella;
using Numbers = std::vector<double>;

TEST_CASE("the solution of a subproblem meets its optimality conditions", "[optimization]") {
    // The approximations are written as sums of p / (upp - x) + q / (x - low), as the paper has them.
    const std::uint32_t seed = 20240607;
    INFO("seed " << seed);
    std::mt19937 random(seed);
    const auto draw = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
    };
    for (std::size_t trial = 0; trial < 300; ++trial) {
        const std::size_t m = trial % (max_mma_constraints + 1), n = 1 + trial * 7 % 40;
        const bool is_linear = trial % 2 == 0, has_z = trial % 3 == 0;
        CAPTURE(trial, m, n, is_linear, has_z);
        Numbers x, lower, upper, values;
        std::vector<Numbers> gradients(m + 1);
        MmaAsymptotes asymptotes;
        MmaOptions options;
        MmaConvexity convexity;
        convexity.fill(trial % 5 == 0 ? 0.3 : 1e-5);
        options.move = draw(0.1, 1);
        for (std::size_t j = 0; j < n; ++j) {
            lower.push_back(draw(-2, 2));
            upper.push_back(lower[j] + draw(0, 3));
            x.push_back(draw(lower[j], upper[j]));
            asymptotes.low.push_back(x[j] - draw(0.01, 2) * (upper[j] - lower[j]));
            asymptotes.upp.push_back(x[j] + draw(0.01, 2) * (upper[j] - lower[j]));
            for (Numbers& row : gradients) row.push_back(draw(-3, 3));
        }
        for (std::size_t i = 0; i < m; ++i) {
            values.push_back(draw(-6, 6));
            options.a.push_back(has_z && i % 2 == 0 ? draw(0.1, 2) : 0);
            options.c.push_back(trial % 7 == 0 ? draw(0, 2) + (is_linear ? 0.1 : 0) : 1000);
            options.d.push_back(is_linear ? 0 : draw(0.1, 2));
        }
        const MmaPoint point{
            x,      lower,
            upper,  gradients[0],
            values, std::vector<std::span<const double>>(gradients.begin() + 1, gradients.end())};
        const MmaSolution found = solve_mma_subproblem(point, asymptotes, options, convexity);

        Numbers rest = values, slope_of_x(n);
        for (std::size_t j = 0; j < n; ++j) {
            const double u = asymptotes.upp[j], l = asymptotes.low[j], range = upper[j] - lower[j];
            for (std::size_t f = 0; f <= m; ++f) {
                const double g = gradients[f][j], e = 0.001 * std::abs(g) + convexity[f] / range;
                const double p = (u - x[j]) * (u - x[j]) * (std::max(g, 0.0) + e);
                const double q = (x[j] - l) * (x[j] - l) * (std::max(-g, 0.0) + e);
                const double to = found.x[j];
                const double weight = f == 0 ? 1 : found.lambda[f - 1];
                slope_of_x[j] += weight * (p / ((u - to) * (u - to)) - q / ((to - l) * (to - l)));
                if (f > 0) rest[f - 1] += p / (u - to) + q / (to - l) - p / (u - x[j]) - q / (x[j] - l);
            }
            const double alpha = std::max({lower[j], l + 0.1 * (x[j] - l), x[j] - options.move * range});
            const double beta = std::min({upper[j], u - 0.1 * (u - x[j]), x[j] + options.move * range});
            CHECK(found.x[j] >= alpha - 1e-14);
            CHECK(found.x[j] <= beta + 1e-14);
            double scale = 1;
            for (const double lambda : found.lambda) scale += lambda;
            if (found.x[j] > alpha + 1e-12) CHECK(slope_of_x[j] <= 1e-7 * scale / range);
            if (found.x[j] < beta - 1e-12) CHECK(slope_of_x[j] >= -1e-7 * scale / range);
        }
        double slope_of_z = options.a0;
        for (std::size_t i = 0; i < m; ++i) {
            CAPTURE(i, found.lambda[i], found.y[i], found.z);
            CHECK(found.constraints[i] == Approx(rest[i]).margin(1e-9));
            rest[i] -= options.a[i] * found.z + found.y[i];
            const double slope_of_y = options.c[i] + options.d[i] * found.y[i] - found.lambda[i];
            CHECK(rest[i] <= 1e-8);
            CHECK(found.lambda[i] >= 0);
            CHECK(found.y[i] >= 0);
            CHECK(slope_of_y >= -1e-8);
            CHECK(std::abs(found.lambda[i] * rest[i]) <= 1e-6);
            CHECK(std::abs(found.y[i] * slope_of_y) <= 1e-8);
            slope_of_z -= options.a[i] * found.lambda[i];
        }
        CHECK(found.z >= 0);
        CHECK(slope_of_z >= -1e-9);
        CHECK(std::abs(found.z * slope_of_z) <= 1e-8);
    }
}

}  // namespace mma_subproblem_test
