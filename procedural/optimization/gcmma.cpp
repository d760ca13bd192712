// The inner iterations that make approximations conservative.
#include "procedural/optimization/gcmma.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "engine/base/error.h"
#include "procedural/optimization/variable_blocks.h"

namespace lamella {
namespace {

constexpr double least_convexity = 1e-6;
constexpr double first_share = 0.1;  // of the mean of |df/dx| R: the convexity each step begins with
constexpr double accepted = 1e-7;    // by which a function may exceed its approximation, relative to 1 + |f|

/// Returns the convexities a step begins with.
MmaConvexity first_convexity(const MmaPoint& point) {
    const std::size_t n = point.x.size();
    const auto of = [&](std::span<const double> gradient) {
        const auto sum = sum_over_variables<double>(
            n, [&](std::size_t j, double& part) { part += std::abs(gradient[j]) * mma_range(point, j); });
        return std::max(least_convexity, first_share / static_cast<double>(n) * sum);
    };
    MmaConvexity convexity{};
    convexity[0] = of(point.objective_gradient);
    for (std::size_t i = 0; i < point.gradients.size(); ++i) convexity[i + 1] = of(point.gradients[i]);
    return convexity;
}

/// Returns the change at x of an approximation for each unit of its convexity.
double change_by_convexity(const MmaPoint& point, const MmaAsymptotes& asymptotes,
                           std::span<const double> x) {
    constexpr double least = 1e-12;  // x has hardly moved
    const auto sum = sum_over_variables<double>(x.size(), [&](std::size_t j, double& part) {
        const double step = x[j] - point.x[j], low = asymptotes.low[j], upp = asymptotes.upp[j];
        part += step * step * (upp - low) / ((upp - x[j]) * (x[j] - low) * mma_range(point, j));
    });
    return std::max(least, sum);
}

bool are_finite(const MmaValues& values) {
    return std::isfinite(values.objective) &&
           std::ranges::all_of(values.constraints, [](double v) { return std::isfinite(v); });
}

/// Makes an approximation more convex if the function exceeds it. Returns whether it does.
bool raise_convexity(double& convexity, double value, double approximation, double change) {
    if (value <= approximation + accepted * (1 + std::abs(approximation))) return false;
    const double most = 10 * convexity, wanted = 1.1 * (convexity + (value - approximation) / change);
    convexity = wanted < most ? wanted : most;  // most, too, where the value is NaN
    return true;
}

}  // namespace

Gcmma::Gcmma(std::size_t variables, std::size_t constraints, MmaOptions options)
    : variables_(variables),
      constraints_(constraints),
      options_(checked_mma_options(std::move(options), variables, constraints)) {}

GcmmaStep Gcmma::update(const MmaPoint& point, double objective, const Evaluate& evaluate) {
    check_mma_point(point, variables_, constraints_);
    if (!std::isfinite(objective)) throw FaultError("moving asymptotes: the objective is not finite");
    MmaAsymptotes asymptotes = moved_asymptotes(state_, point, options_);
    MmaConvexity convexity = first_convexity(point);
    GcmmaStep step;
    while (step.evaluations < max_gcmma_evaluations && !step.is_conservative) {
        MmaSolution solution = solve_mma_subproblem(point, asymptotes, options_, convexity);
        step.values = evaluate(solution.x);
        if (step.values.constraints.size() != constraints_)
            throw InputError("moving asymptotes: " + std::to_string(step.values.constraints.size()) +
                             " constraints were evaluated; " + std::to_string(constraints_) + " are needed");
        ++step.evaluations;
        const double change = change_by_convexity(point, asymptotes, solution.x);
        bool exceeds = raise_convexity(convexity[0], step.values.objective,
                                       objective + solution.objective_change, change);
        for (std::size_t i = 0; i < constraints_; ++i)
            exceeds = raise_convexity(convexity[i + 1], step.values.constraints[i], solution.constraints[i],
                                      change) ||
                      exceeds;
        step.is_conservative = !exceeds;
        step.x = std::move(solution.x);
        step.lambda = std::move(solution.lambda), step.y = std::move(solution.y), step.z = solution.z;
    }
    if (!are_finite(step.values))
        throw FaultError("moving asymptotes: no step was found at which the functions are finite");
    remember_mma_step(state_, point.x, std::move(asymptotes));
    return step;
}

void Gcmma::set_state(MmaState state) {
    check_mma_state(state, variables_);
    state_ = std::move(state);
}

}  // namespace lamella
