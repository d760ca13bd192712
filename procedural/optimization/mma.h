// Mma: the method of moving asymptotes, for many variables and few constraints.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "procedural/optimization/mma_subproblem.h"

namespace lamella {

/// What the method remembers from step to step: plain data, to be written down and read again.
struct MmaState {
    int steps = 0;               ///< steps since the asymptotes were set anew
    std::vector<double> former;  ///< x one step ago; empty before the first step
    std::vector<double> before;  ///< x two steps ago; empty before the second
    MmaAsymptotes asymptotes;    ///< those of the last step; empty before the first
};

/// Svanberg's method of moving asymptotes. Each step replaces every function by a convex separable one around
/// the present x, and goes to the minimum of these (Svanberg, "The method of moving asymptotes - a new method
/// for structural optimization", 1987; rules and constants of "MMA and GCMMA", 2007, with
/// asymptotes 0.01 to 10 ranges away). Convergence is not certain: around a minimum inside the bounds x may
/// swing by about 0.01 ranges if slopes are large beside raa; Gcmma does not. The bits do not depend on the
/// number of threads.
class Mma {
  public:
    /// Throws InputError for no variables, more than max_mma_constraints constraints, or options out of
    /// range.
    Mma(std::size_t variables, std::size_t constraints, MmaOptions options = {});

    /// Takes one step; the solution's x is the next x, within its bounds. Throws InputError for wrong sizes
    /// or an x outside its bounds, and FaultError for a number that is not finite; then the state is as
    /// before.
    MmaSolution update(const MmaPoint& point);
    /// Forgets the former steps. Needed whenever the functions themselves change: another penalty exponent,
    /// another sharpness of the projection.
    void reset_asymptotes() { state_ = {}; }

    const MmaState& state() const { return state_; }
    /// Goes on where another object was. Throws InputError for a state that does not fit.
    void set_state(MmaState state);

  private:
    std::size_t variables_;
    std::size_t constraints_;
    MmaOptions options_;
    MmaState state_;
};

/// Returns the options with their a, c and d for each constraint. Throws as the constructor of Mma does.
MmaOptions checked_mma_options(MmaOptions options, std::size_t variables, std::size_t constraints);
/// Throws as Mma::update does.
void check_mma_point(const MmaPoint& point, std::size_t variables, std::size_t constraints);
/// Throws as Mma::set_state does.
void check_mma_state(const MmaState& state, std::size_t variables);
/// Returns the asymptotes for a step from the point.
MmaAsymptotes moved_asymptotes(const MmaState& state, const MmaPoint& point, const MmaOptions& options);
/// Remembers a step that began at x with these asymptotes.
void remember_mma_step(MmaState& state, std::span<const double> x, MmaAsymptotes asymptotes);

}  // namespace lamella
