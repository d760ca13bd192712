// The rules by which asymptotes move, and the checks of what comes in.
#include "procedural/optimization/mma.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "engine/base/error.h"
#include "procedural/optimization/variable_blocks.h"

namespace lamella {
namespace {

constexpr double nearest_asymptote = 0.01;  // distances from x, as shares of the range
constexpr double farthest_asymptote = 10;

void check_count(const char* what, std::size_t found, std::size_t wanted) {
    if (found != wanted)
        throw InputError(std::string("moving asymptotes: ") + std::to_string(found) + " " + what + "; " +
                         std::to_string(wanted) + " are needed");
}

void check_option(const char* name, double value, bool is_right, const char* accepted) {
    if (!is_right)
        throw InputError(std::string("moving asymptotes: ") + name + " is " + std::to_string(value) +
                         "; accepted: " + accepted);
}

/// Throws unless the numbers are finite.
void check_finite(const char* what, std::span<const double> numbers) {
    const auto bad = sum_over_variables<std::size_t>(
        numbers.size(), [&](std::size_t j, std::size_t& sum) { sum += std::isfinite(numbers[j]) ? 0 : 1; });
    if (bad == 0) return;
    const auto first = std::ranges::find_if(numbers, [](double v) { return !std::isfinite(v); });
    throw FaultError(std::string("moving asymptotes: ") + what + " has " + std::to_string(bad) +
                     " numbers that are not finite; the first is number " +
                     std::to_string(first - numbers.begin() + 1));
}

void fill_option(std::vector<double>& numbers, std::size_t constraints, double usual, const char* name) {
    if (numbers.empty()) numbers.assign(constraints, usual);
    check_count(name, numbers.size(), constraints);
    for (const double v : numbers) check_option(name, v, std::isfinite(v) && v >= 0, "0 and more");
}

}  // namespace

MmaOptions checked_mma_options(MmaOptions options, std::size_t variables, std::size_t constraints) {
    if (variables == 0) throw InputError("moving asymptotes: there are no variables");
    if (constraints > max_mma_constraints)
        throw InputError("moving asymptotes: " + std::to_string(constraints) + " constraints; at most " +
                         std::to_string(max_mma_constraints) + " are accepted");
    fill_option(options.a, constraints, 0, "numbers a");
    fill_option(options.c, constraints, 1000, "numbers c");
    fill_option(options.d, constraints, 1, "numbers d");
    for (std::size_t i = 0; i < constraints; ++i)
        check_option("c + d", options.c[i] + options.d[i], options.c[i] + options.d[i] > 0, "above 0");
    const auto is_within = [](double v, double low, double high) { return v > low && v <= high; };
    check_option("a0", options.a0, options.a0 > 0 && std::isfinite(options.a0), "above 0");
    check_option("move", options.move, is_within(options.move, 0, 1), "above 0, at most 1");
    check_option("start", options.start, is_within(options.start, 0, farthest_asymptote),
                 "above 0, at most 10");
    check_option("widen", options.widen, options.widen >= 1 && std::isfinite(options.widen), "1 and more");
    check_option("narrow", options.narrow, is_within(options.narrow, 0, 1), "above 0, at most 1");
    check_option("raa", options.raa, options.raa > 0 && std::isfinite(options.raa), "above 0");
    return options;
}

void check_mma_point(const MmaPoint& point, std::size_t variables, std::size_t constraints) {
    check_count("variables", point.x.size(), variables);
    check_count("lower bounds", point.lower.size(), variables);
    check_count("upper bounds", point.upper.size(), variables);
    check_count("slopes of the objective", point.objective_gradient.size(), variables);
    check_count("constraints", point.constraints.size(), constraints);
    check_count("gradients of constraints", point.gradients.size(), constraints);
    for (const auto& row : point.gradients) check_count("slopes of a constraint", row.size(), variables);

    check_finite("x", point.x);
    check_finite("the lower bound", point.lower);
    check_finite("the upper bound", point.upper);
    check_finite("the objective's gradient", point.objective_gradient);
    check_finite("the list of constraints", point.constraints);
    for (const auto& row : point.gradients) check_finite("a constraint's gradient", row);

    const auto is_outside = [&](std::size_t j) {
        return !(point.lower[j] <= point.x[j] && point.x[j] <= point.upper[j]);
    };
    const auto outside = sum_over_variables<std::size_t>(
        variables, [&](std::size_t j, std::size_t& sum) { sum += is_outside(j) ? 1 : 0; });
    if (outside == 0) return;
    std::size_t j = 0;
    while (!is_outside(j)) ++j;
    throw InputError("moving asymptotes: variable " + std::to_string(j + 1) + " is " +
                     std::to_string(point.x[j]) + "; its bounds are " + std::to_string(point.lower[j]) +
                     " and " + std::to_string(point.upper[j]));
}

void check_mma_state(const MmaState& state, std::size_t variables) {
    if (state.steps < 0) throw InputError("moving asymptotes: a state has no fewer than 0 steps");
    const std::size_t known = state.steps > 0 ? variables : 0;
    check_count("former variables in the state", state.former.size(), known);
    check_count("variables before these in the state", state.before.size(), state.steps > 1 ? variables : 0);
    check_count("lower asymptotes in the state", state.asymptotes.low.size(), known);
    check_count("upper asymptotes in the state", state.asymptotes.upp.size(), known);
    for (std::size_t j = 0; j < known; ++j) {
        // NaN fails, too
        const bool is_right = state.asymptotes.low[j] < state.former[j] &&
                              state.former[j] < state.asymptotes.upp[j] &&
                              (state.steps < 2 || std::isfinite(state.before[j]));
        if (!is_right)
            throw InputError("moving asymptotes: in the state, variable " + std::to_string(j + 1) +
                             " does not lie between its asymptotes");
    }
}

MmaAsymptotes moved_asymptotes(const MmaState& state, const MmaPoint& point, const MmaOptions& options) {
    const std::size_t n = point.x.size();
    MmaAsymptotes to;
    to.low.resize(n), to.upp.resize(n);
    const auto move = [&](std::size_t j) {
        const double x = point.x[j], range = mma_range(point, j);
        if (state.steps < 2) {
            to.low[j] = x - options.start * range;
            to.upp[j] = x + options.start * range;
            return;
        }
        const double former = state.former[j];
        // Signs are compared: the product of two tiny steps would be 0.
        const double last = x - former, earlier = former - state.before[j];
        double factor = 1;
        if (last != 0 && earlier != 0) factor = (last > 0) == (earlier > 0) ? options.widen : options.narrow;
        const double nearest = nearest_asymptote * range, farthest = farthest_asymptote * range;
        to.low[j] = x - std::clamp(factor * (former - state.asymptotes.low[j]), nearest, farthest);
        to.upp[j] = x + std::clamp(factor * (state.asymptotes.upp[j] - former), nearest, farthest);
    };
    for_each_variable_block(n, [&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t j = begin; j < end; ++j) move(j);
    });
    return to;
}

void remember_mma_step(MmaState& state, std::span<const double> x, MmaAsymptotes asymptotes) {
    std::vector<double> now(x.begin(), x.end());
    state.before = std::move(state.former);
    state.former = std::move(now);
    state.asymptotes = std::move(asymptotes);
    ++state.steps;
}

Mma::Mma(std::size_t variables, std::size_t constraints, MmaOptions options)
    : variables_(variables),
      constraints_(constraints),
      options_(checked_mma_options(std::move(options), variables, constraints)) {}

MmaSolution Mma::update(const MmaPoint& point) {
    check_mma_point(point, variables_, constraints_);
    MmaAsymptotes asymptotes = moved_asymptotes(state_, point, options_);
    MmaConvexity convexity;
    convexity.fill(options_.raa);
    MmaSolution solution = solve_mma_subproblem(point, asymptotes, options_, convexity);
    remember_mma_step(state_, point.x, std::move(asymptotes));
    return solution;
}

void Mma::set_state(MmaState state) {
    check_mma_state(state, variables_);
    state_ = std::move(state);
}

}  // namespace lamella
