// Approximations around the present point, and the interior point method for their dual.
#include "procedural/optimization/mma_subproblem.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/base/error.h"
#include "procedural/optimization/variable_blocks.h"

namespace lamella {
namespace {

constexpr std::size_t most = max_mma_constraints;
using DualNumbers = std::array<double, most>;

constexpr double approach = 0.9;          // share of the way to an asymptote that x may go in a step
constexpr double curved_share = 0.001;    // of |df/dx|: makes every approximation strictly convex
constexpr double last_barrier = 1e-10;    // of the interior point method: lambda_i times slack at the end
constexpr double rounding = 1e-14;        // noise of a function relative to the sum of its terms
constexpr double failed = 1e-6;           // error of a constraint, relative to its terms, that is no solution
constexpr double boundary_factor = 1.01;  // a step goes at most 1/1.01 of the way to where a slack is 0
constexpr int max_newton_steps = 60;      // for one barrier
constexpr int max_trials = 30;            // lengths tried along one Newton step

/// Sums over all variables that the dual needs at one lambda.
struct DualSums {
    double objective_change = 0;
    DualNumbers change{};                               // of the constraints' approximations
    std::array<double, most*(most + 1) / 2> hessian{};  // minus that of the dual: lower triangle by rows

    DualSums& operator+=(const DualSums& other) {
        objective_change += other.objective_change;
        for (std::size_t i = 0; i < most; ++i) change[i] += other.change[i];
        for (std::size_t k = 0; k < hessian.size(); ++k) hessian[k] += other.hessian[k];
        return *this;
    }
};

/// Sums of the magnitudes of a function's terms: what its rounding errors are relative to.
struct TermSums {
    DualNumbers terms{};

    TermSums& operator+=(const TermSums& other) {
        for (std::size_t i = 0; i < most; ++i) terms[i] += other.terms[i];
        return *this;
    }
};

/// Unknowns of the interior point method. The slacks are kept beside lambda, as they are tiny at the end.
struct DualUnknowns {
    DualNumbers lambda{};
    DualNumbers below{};  // c - lambda: positive where d is 0
    double slack = 0;     // a0 - sum a lambda
};

/// Takes the multiplier of a positive unknown along a part t of its Newton step, and returns it. Far from
/// barrier / unknown, which it is in the end, it would spoil the next steps.
double followed(double multiplier, double unknown, double step, double t, double barrier) {
    constexpr double trust = 1e10;
    const double central = barrier / (unknown + t * step);
    const double next = multiplier + t * (barrier / unknown - multiplier - multiplier / unknown * step);
    return std::clamp(next, central / trust, central * trust);
}

/// Solves the system with the lower triangle of a symmetric positive definite matrix by factors L D L^T.
DualNumbers solve_dual_system(std::array<double, most*(most + 1) / 2> matrix, DualNumbers b, std::size_t m) {
    const auto at = [&](std::size_t i, std::size_t k) -> double& { return matrix[i * (i + 1) / 2 + k]; };
    for (std::size_t k = 0; k < m; ++k) {
        const double diagonal = at(k, k);
        for (std::size_t l = 0; l < k; ++l) at(k, k) -= at(k, l) * at(k, l) * at(l, l);
        // parallel gradients leave nothing but rounding errors here
        at(k, k) = std::max(at(k, k), rounding * diagonal);
        for (std::size_t i = k + 1; i < m; ++i) {
            for (std::size_t l = 0; l < k; ++l) at(i, k) -= at(i, l) * at(k, l) * at(l, l);
            at(i, k) /= at(k, k);
        }
    }
    for (std::size_t i = 0; i < m; ++i) {
        for (std::size_t k = 0; k < i; ++k) b[i] -= at(i, k) * b[k];
    }
    for (std::size_t i = 0; i < m; ++i) b[i] /= at(i, i);
    for (std::size_t i = m; i-- > 0;) {
        for (std::size_t k = i + 1; k < m; ++k) b[i] -= at(k, i) * b[k];
    }
    return b;
}

/// The dual of a subproblem: a concave function of lambda whose gradient is the constraints' values at the
/// x, y, z that are best for lambda.
class MmaDual {
  public:
    MmaDual(const MmaPoint& point, const MmaAsymptotes& asymptotes, const MmaOptions& options,
            const MmaConvexity& convexity)
        : point_(point), asymptotes_(asymptotes), options_(options), convexity_(convexity) {
        tolerance_ = sum_over_variables<TermSums>(point_.x.size(), [&](std::size_t j, TermSums& sums) {
                         if (point_.lower[j] == point_.upper[j]) return;
                         const double length =
                             std::abs(point_.x[j]) + asymptotes_.upp[j] - asymptotes_.low[j];
                         for (std::size_t i = 0; i < m_; ++i)
                             sums.terms[i] += std::abs(point_.gradients[i][j]) * length;
                     }).terms;
        for (std::size_t i = 0; i < m_; ++i)
            tolerance_[i] = rounding * (tolerance_[i] + std::abs(point_.constraints[i]));
        for (const double a : options_.a) has_z_ = has_z_ || a > 0;
        start();
    }

    void maximise() {
        sums_ = sums_at(at_.lambda);
        while (m_ > 0) {
            for (int step = 0; step < max_newton_steps && !is_solved(gradient_at(at_, sums_)); ++step)
                take_newton_step();
            if (barrier_ <= last_barrier) break;
            barrier_ = std::max(last_barrier, std::min(0.1 * barrier_, barrier_ * std::sqrt(barrier_)));
        }
        const DualNumbers rest = gradient_at(at_, sums_);
        for (std::size_t i = 0; i < m_; ++i) {
            if (!(std::abs(rest[i]) <= failed * std::max(1.0, tolerance_[i] / rounding)))
                throw FaultError("moving asymptotes: the subproblem was not solved; constraint " +
                                 std::to_string(i + 1) + " is off by " + std::to_string(rest[i]));
        }
    }

    MmaSolution solution() const {
        MmaSolution out;
        out.x.resize(point_.x.size());
        for_each_variable_block(point_.x.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
            for (std::size_t j = begin; j < end; ++j) out.x[j] = place_of(j, at_.lambda).x;
        });
        for (std::size_t i = 0; i < m_; ++i) {
            out.lambda.push_back(at_.lambda[i]);
            out.y.push_back(y_at(i, at_.below[i]).y);
            out.constraints.push_back(point_.constraints[i] + sums_.change[i]);
        }
        out.z = has_z_ ? barrier_ / at_.slack : 0;
        out.objective_change = sums_.objective_change;
        return out;
    }

  private:
    struct Weights {
        double p, q;
    };
    /// The best place of a variable for some lambda, and the approximations' slopes around it.
    struct Place {
        double x;
        double step;                  // x minus the present x
        double to_upp, to_low;        // distances from x to the asymptotes
        double ratio_upp, ratio_low;  // present distances to the asymptotes over these
        double p, q;                  // weights of the Lagrangian's terms in 1/(upp - x) and 1/(x - low)
        bool is_free;
        Weights objective;
        std::array<Weights, most> of;  // the constraints
    };
    struct Penalty {
        double y;
        double slope;  // dy / dlambda
    };

    /// Weights of function `row` relative to the squared present distances to the asymptotes: its slopes up
    /// and down, plus a share of curvature.
    Weights weights_of(double slope, std::size_t row, double per_range) const {
        const double curved = curved_share * std::abs(slope) + convexity_[row] * per_range;
        return {std::max(slope, 0.0) + curved, std::max(-slope, 0.0) + curved};
    }

    Place place_of(std::size_t j, const DualNumbers& lambda) const {
        const double present = point_.x[j], upp = asymptotes_.upp[j] - present,
                     low = present - asymptotes_.low[j];
        Place at;
        const double range = mma_range(point_, j), per_range = 1 / range;
        at.objective = weights_of(point_.objective_gradient[j], 0, per_range);
        at.p = at.objective.p, at.q = at.objective.q;
        for (std::size_t i = 0; i < m_; ++i) {
            at.of[i] = weights_of(point_.gradients[i][j], i + 1, per_range);
            at.p += lambda[i] * at.of[i].p, at.q += lambda[i] * at.of[i].q;
        }
        const double least =
            std::max({point_.lower[j], present - approach * low, present - options_.move * range});
        const double greatest =
            std::min({point_.upper[j], present + approach * upp, present + options_.move * range});
        // minimum of upp^2 p / (upp - step) + low^2 q / (low + step)
        const double up = std::sqrt(at.p), down = std::sqrt(at.q);
        at.x = present + upp * low * (down - up) / (upp * up + low * down);
        at.is_free = least < at.x && at.x < greatest;
        at.x = std::max(least, std::min(at.x, greatest));
        at.step = at.x - present;
        at.to_upp = asymptotes_.upp[j] - at.x, at.to_low = at.x - asymptotes_.low[j];
        at.ratio_upp = upp / at.to_upp, at.ratio_low = low / at.to_low;
        return at;
    }

    /// Changes of the approximations are summed, not their values: they are small near the optimum.
    DualSums sums_at(const DualNumbers& lambda) const {
        return sum_over_variables<DualSums>(point_.x.size(), [&](std::size_t j, DualSums& sums) {
            const Place at = place_of(j, lambda);
            const auto change = [&](const Weights& w) {
                return at.step * (w.p * at.ratio_upp - w.q * at.ratio_low);
            };
            sums.objective_change += change(at.objective);
            const double upp = at.ratio_upp * at.ratio_upp, low = at.ratio_low * at.ratio_low;
            const double softness =
                at.is_free ? 0.5 / (at.p * upp / at.to_upp + at.q * low / at.to_low) : 0.0;
            DualNumbers slope;
            for (std::size_t i = 0; i < m_; ++i) {
                const Weights& w = at.of[i];
                sums.change[i] += change(w);
                slope[i] = w.p * upp - w.q * low;
                for (std::size_t k = 0; k <= i; ++k)
                    sums.hessian[i * (i + 1) / 2 + k] += softness * slope[i] * slope[k];
            }
        });
    }

    /// Starts inside: 0 < lambda, lambda < c where d is 0, and sum a lambda < a0.
    void start() {
        at_.slack = options_.a0;
        for (std::size_t i = 0; i < m_; ++i) {
            double lambda = options_.c[i] > 0 ? std::min(1.0, options_.c[i] / 2) : 1.0;
            if (options_.a[i] > 0)
                lambda = std::min(lambda, options_.a0 / (2 * static_cast<double>(m_) * options_.a[i]));
            at_.lambda[i] = lambda;
            at_.below[i] = options_.c[i] - lambda;
            at_.slack -= options_.a[i] * lambda;
            of_lambda_[i] = barrier_ / lambda;
            of_below_[i] = barrier_ / at_.below[i];
        }
        of_slack_ = barrier_ / at_.slack;
    }

    /// The y_i that is best for c_i - lambda_i, smoothed by the barrier: y (c + d y - lambda) = barrier.
    Penalty y_at(std::size_t i, double below) const {
        const double d = options_.d[i], root = std::sqrt(below * below + 4 * d * barrier_);
        const double y = below >= 0 ? 2 * barrier_ / (below + root) : (root - below) / (2 * d);
        return {y, y / root};
    }

    /// The gradient of the dual with barrier: what is missing to each constraint.
    DualNumbers gradient_at(const DualUnknowns& at, const DualSums& sums) const {
        DualNumbers gradient{};
        const double z = has_z_ ? barrier_ / at.slack : 0;
        for (std::size_t i = 0; i < m_; ++i)
            gradient[i] = point_.constraints[i] + sums.change[i] + barrier_ / at.lambda[i] -
                          y_at(i, at.below[i]).y - options_.a[i] * z;
        return gradient;
    }

    bool is_solved(const DualNumbers& gradient) const {
        for (std::size_t i = 0; i < m_; ++i) {
            if (!(std::abs(gradient[i]) <= barrier_ + tolerance_[i])) return false;
        }
        return true;
    }

    DualNumbers newton_step(const DualNumbers& gradient) const {
        auto matrix = sums_.hessian;
        for (std::size_t i = 0; i < m_; ++i) {
            double& diagonal = matrix[i * (i + 1) / 2 + i];
            diagonal += of_lambda_[i] / at_.lambda[i];
            diagonal += options_.d[i] > 0 ? y_at(i, at_.below[i]).slope : of_below_[i] / at_.below[i];
            if (!has_z_) continue;
            for (std::size_t k = 0; k <= i; ++k)
                matrix[i * (i + 1) / 2 + k] += options_.a[i] * options_.a[k] * of_slack_ / at_.slack;
        }
        return solve_dual_system(matrix, gradient, m_);
    }

    double slack_step(const DualNumbers& step) const {
        double sum = 0;
        for (std::size_t i = 0; i < m_; ++i) sum -= options_.a[i] * step[i];
        return sum;
    }

    /// Returns the part of a step that stays inside, at most all of it.
    double longest_part(const DualNumbers& step) const {
        double fastest = std::max(1 / boundary_factor, -slack_step(step) / at_.slack);
        for (std::size_t i = 0; i < m_; ++i) {
            fastest = std::max(fastest, -step[i] / at_.lambda[i]);
            if (options_.d[i] == 0) fastest = std::max(fastest, step[i] / at_.below[i]);
        }
        return 1 / (boundary_factor * fastest);
    }

    DualUnknowns moved(const DualNumbers& step, double t) const {
        DualUnknowns to = at_;
        for (std::size_t i = 0; i < m_; ++i) {
            to.lambda[i] += t * step[i];
            to.below[i] -= t * step[i];
        }
        to.slack += t * slack_step(step);
        return to;
    }

    /// A Newton step shortened so that it stays inside and does not go far beyond the maximum on its line.
    /// The slope along the line decides, not the value: the slope falls steadily, and rounding hides no
    /// digits.
    void take_newton_step() {
        const DualNumbers gradient = gradient_at(at_, sums_), step = newton_step(gradient);
        const auto along = [&](const DualNumbers& g) {
            double sum = 0;
            for (std::size_t i = 0; i < m_; ++i) sum += g[i] * step[i];
            return sum;
        };
        const double longest = longest_part(step), first_slope = along(gradient);
        double t = longest, near = 0, near_slope = first_slope, far = longest, far_slope = 0;
        DualUnknowns to;
        for (int trial = 1;; ++trial) {
            to = moved(step, t);
            sums_ = sums_at(to.lambda);
            const DualNumbers here = gradient_at(to, sums_);
            const double slope = along(here);
            const bool is_near = slope > 0.9 * first_slope && t < longest;
            const bool is_good = slope >= -0.1 * first_slope && !is_near;
            if (is_good || is_solved(here) || trial == max_trials) break;
            (is_near ? near : far) = t;
            (is_near ? near_slope : far_slope) = slope;
            t = near + (far - near) * std::clamp(near_slope / (near_slope - far_slope), 0.1, 0.9);
        }
        for (std::size_t i = 0; i < m_; ++i) {
            of_lambda_[i] = followed(of_lambda_[i], at_.lambda[i], step[i], t, barrier_);
            if (options_.d[i] == 0)
                of_below_[i] = followed(of_below_[i], at_.below[i], -step[i], t, barrier_);
        }
        of_slack_ = followed(of_slack_, at_.slack, slack_step(step), t, barrier_);
        at_ = to;
    }

    const MmaPoint& point_;
    const MmaAsymptotes& asymptotes_;
    const MmaOptions& options_;
    const MmaConvexity& convexity_;
    std::size_t m_ = point_.constraints.size();
    bool has_z_ = false;
    DualNumbers tolerance_{};  // of the constraints: their rounding errors
    double barrier_ = 1;
    DualUnknowns at_;
    DualNumbers of_lambda_{};  // multipliers of lambda > 0: the constraints' slacks
    DualNumbers of_below_{};   // multipliers of c - lambda > 0: y, where d is 0
    double of_slack_ = 0;      // multiplier of a0 - sum a lambda > 0: z
    DualSums sums_;            // at at_.lambda
};

}  // namespace

MmaSolution solve_mma_subproblem(const MmaPoint& point, const MmaAsymptotes& asymptotes,
                                 const MmaOptions& options, const MmaConvexity& convexity) {
    MmaDual dual(point, asymptotes, options, convexity);
    dual.maximise();
    return dual.solution();
}

}  // namespace lamella
