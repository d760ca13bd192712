// The convex separable subproblem of the method of moving asymptotes, and its solution through the dual.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace lamella {

/// Most constraints a problem may have: the dual has one unknown for each.
inline constexpr std::size_t max_mma_constraints = 8;

/// The problem is: minimise f_0(x) + a0 z + sum_i (c_i y_i + d_i y_i^2 / 2) subject to
/// f_i(x) - a_i z - y_i <= 0, lower <= x <= upper, y >= 0, z >= 0 (Svanberg, "MMA and GCMMA - two methods for
/// nonlinear optimization", 2007). y makes every subproblem feasible; z serves min-max problems.
/// Functions should be scaled to magnitudes of 1 to 100, and c be larger than every multiplier.
struct MmaOptions {
    double a0 = 1;
    /// One number for each constraint; empty means 0, 1000 and 1.
    std::vector<double> a = {}, c = {}, d = {};
    double move = 0.5;    ///< most change of a variable in a step, as a share of upper - lower
    double start = 0.5;   ///< distance of the first asymptotes, as a share of upper - lower
    double widen = 1.2;   ///< factor on that distance where a variable keeps its direction
    double narrow = 0.7;  ///< factor on that distance where a variable swings
    double raa = 1e-5;    ///< least convexity of the approximations (not of those of Gcmma)
};

/// What is known of the functions at the present x. Spans are read only during the call.
struct MmaPoint {
    std::span<const double> x;
    std::span<const double> lower, upper;            ///< bounds of x; equal ones fix a variable
    std::span<const double> objective_gradient;      ///< df_0/dx
    std::span<const double> constraints;             ///< f_1(x) to f_m(x)
    std::vector<std::span<const double>> gradients;  ///< df_i/dx, one row for each constraint
};

/// Asymptotes of the approximations, one pair for each variable: low < x < upp.
struct MmaAsymptotes {
    std::vector<double> low, upp;
};

/// Solution of a subproblem, with what its approximations say there.
struct MmaSolution {
    std::vector<double> x;
    std::vector<double> lambda;  ///< multipliers of the constraints
    std::vector<double> y;
    double z = 0;
    double objective_change = 0;      ///< approximation of f_0(x) minus f_0 at the present x
    std::vector<double> constraints;  ///< approximations of f_i(x)
};

/// Convexity of each approximation (Svanberg's rho): the objective's, then those of the constraints.
using MmaConvexity = std::array<double, max_mma_constraints + 1>;

/// Returns the width R of a variable's range, as the rules of the method use it: upper - lower, but not 0.
inline double mma_range(const MmaPoint& point, std::size_t j) {
    constexpr double least = 1e-5;
    const double range = point.upper[j] - point.lower[j];
    return range > least ? range : least;
}

/// Solves the subproblem at a point. Options have their a, c and d; sizes fit and low < x < upp.
/// Approximations are those of Svanberg 2007; the dual is maximised by a primal-dual interior
/// point method in lambda alone, as x, y and z are known in closed form. With many variables
/// it costs some 10 to 20 sweeps over the gradients, each of about 30 ns a variable for one constraint and
/// 110 ns for eight. The bits do not depend on the number of threads. Throws FaultError if the dual does not
/// converge.
MmaSolution solve_mma_subproblem(const MmaPoint& point, const MmaAsymptotes& asymptotes,
                                 const MmaOptions& options, const MmaConvexity& convexity);

}  // namespace lamella
