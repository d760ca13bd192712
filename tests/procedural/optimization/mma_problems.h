// Published problems for the method of moving asymptotes, and how far a point is from being their solution.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "procedural/optimization/gcmma.h"

namespace lamella::mma_problems {

using Numbers = std::vector<double>;

struct Problem {
    MmaOptions options;
    Numbers lower, upper, first;
    std::function<MmaValues(std::span<const double>)> values;
    /// Gradients of the objective and then of the constraints.
    std::function<std::vector<Numbers>(std::span<const double>)> gradients;
};

/// Calls work(point, objective) with what is known at x.
template <typename Work>
auto with_point(const Problem& problem, const Numbers& x, const Work& work) {
    const MmaValues values = problem.values(x);
    const std::vector<Numbers> gradients = problem.gradients(x);
    return work(MmaPoint{x, problem.lower, problem.upper, gradients[0], values.constraints,
                         std::vector<std::span<const double>>(gradients.begin() + 1, gradients.end())},
                values.objective);
}

/// Returns how far x with its multipliers is from the conditions of Karush, Kuhn and Tucker: the greatest of
/// the projected gradient of the Lagrangian, of the violated constraints, and of the products that have to
/// be 0.
inline double kkt_residual(const Problem& problem, const Numbers& x, const Numbers& lambda, const Numbers& y,
                           double z) {
    const MmaValues values = problem.values(x);
    const std::vector<Numbers> gradients = problem.gradients(x);
    const std::size_t m = lambda.size();
    const auto option = [&](const Numbers& given, std::size_t i, double usual) {
        return given.empty() ? usual : given[i];
    };
    double worst = 0;
    const auto see = [&](double error) { worst = std::max(worst, std::isnan(error) ? 1e300 : error); };
    for (std::size_t j = 0; j < x.size(); ++j) {
        double slope = gradients[0][j];
        for (std::size_t i = 0; i < m; ++i) slope += lambda[i] * gradients[i + 1][j];
        see(std::abs(x[j] - std::clamp(x[j] - slope, problem.lower[j], problem.upper[j])));
    }
    double slope_of_z = problem.options.a0;
    for (std::size_t i = 0; i < m; ++i) {
        const double a = option(problem.options.a, i, 0);
        const double rest = values.constraints[i] - a * z - y[i];
        const double slope_of_y =
            option(problem.options.c, i, 1000) + option(problem.options.d, i, 1) * y[i] - lambda[i];
        for (const double below : {rest, -lambda[i], -y[i], -slope_of_y}) see(below);
        see(std::abs(lambda[i] * rest));
        see(std::abs(y[i] * slope_of_y));
        slope_of_z -= a * lambda[i];
    }
    for (const double below : {-z, -slope_of_z}) see(below);
    see(std::abs(z * slope_of_z));
    return worst;
}

/// A cantilever of five box sections, lightest for a given deflection of its tip: Svanberg 1987.
inline Problem beam() {
    static constexpr std::array<double, 5> share{61, 37, 19, 7, 1};
    Problem problem{{}, Numbers(5, 1), Numbers(5, 10), Numbers(5, 5), {}, {}};
    problem.values = [](std::span<const double> x) {
        MmaValues at{0, {-1}};
        for (std::size_t j = 0; j < 5; ++j) {
            at.objective += 0.0624 * x[j];
            at.constraints[0] += share[j] / (x[j] * x[j] * x[j]);
        }
        return at;
    };
    problem.gradients = [](std::span<const double> x) {
        std::vector<Numbers> rows{Numbers(5, 0.0624), Numbers(5)};
        for (std::size_t j = 0; j < 5; ++j) rows[1][j] = -3 * share[j] / (x[j] * x[j] * x[j] * x[j]);
        return rows;
    };
    return problem;
}

/// The optimum of beam() by Lagrange: x_j is proportional to the fourth root of share_j.
inline Numbers beam_optimum() {
    Numbers roots;
    double sum = 0;
    for (const double share : {61.0, 37.0, 19.0, 7.0, 1.0}) {
        roots.push_back(std::sqrt(std::sqrt(share)));
        sum += roots.back();
    }
    for (double& root : roots) root *= std::cbrt(sum);
    return roots;
}

/// The point closest to the origin in two balls (Svanberg's "toy problem").
inline Problem two_balls() {
    static constexpr std::array<std::array<double, 3>, 2> centre{{{5, 2, 1}, {3, 4, 3}}};
    Problem problem{{}, Numbers(3, 0), Numbers(3, 5), {4, 3, 2}, {}, {}};
    problem.values = [](std::span<const double> x) {
        MmaValues at{0, {-9, -9}};
        for (std::size_t j = 0; j < 3; ++j) {
            at.objective += x[j] * x[j];
            for (std::size_t i = 0; i < 2; ++i)
                at.constraints[i] += (x[j] - centre[i][j]) * (x[j] - centre[i][j]);
        }
        return at;
    };
    problem.gradients = [](std::span<const double> x) {
        std::vector<Numbers> rows(3, Numbers(3));
        for (std::size_t j = 0; j < 3; ++j) {
            rows[0][j] = 2 * x[j];
            for (std::size_t i = 0; i < 2; ++i) rows[i + 1][j] = 2 * (x[j] - centre[i][j]);
        }
        return rows;
    };
    return problem;
}

/// Three bars from one node to three supports, 45 degrees apart. The greatest compliance z under three loads
/// is to be least; the bars' areas sum up to at most 3.
inline Problem three_bars() {
    using Pair = std::array<double, 2>;
    static constexpr std::array<Pair, 3> load{{{1, 0}, {1, 1}, {0, 1}}};
    const auto displacement = [](std::span<const double> x, const Pair& f) {
        // bars along (1, 0), (1, 1) / sqrt 2 and (0, 1)
        const double k11 = x[0] + x[1] / 2, k12 = x[1] / 2, k22 = x[2] + x[1] / 2;
        const double determinant = k11 * k22 - k12 * k12;
        return Pair{(k22 * f[0] - k12 * f[1]) / determinant, (k11 * f[1] - k12 * f[0]) / determinant};
    };
    Problem problem{{}, Numbers(3, 0.001), Numbers(3, 3), Numbers(3, 1), {}, {}};
    problem.options.a = {1, 1, 1, 0};
    problem.options.move = 1;
    problem.values = [=](std::span<const double> x) {
        MmaValues at;
        for (const Pair& f : load) {
            const Pair u = displacement(x, f);
            at.constraints.push_back(f[0] * u[0] + f[1] * u[1]);
        }
        at.constraints.push_back(x[0] + x[1] + x[2] - 3);
        return at;
    };
    problem.gradients = [=](std::span<const double> x) {
        std::vector<Numbers> rows{Numbers(3, 0)};
        for (const Pair& f : load) {
            const Pair u = displacement(x, f);
            rows.push_back({-u[0] * u[0], -(u[0] + u[1]) * (u[0] + u[1]) / 2, -u[1] * u[1]});
        }
        rows.push_back(Numbers(3, 1));
        return rows;
    };
    return problem;
}

}  // namespace lamella::mma_problems
