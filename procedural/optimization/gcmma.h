// Gcmma: the globally convergent method of moving asymptotes, for functions that can be evaluated again.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "procedural/optimization/mma.h"

namespace lamella {

/// Values of the objective and the constraints at some x.
struct MmaValues {
    double objective = 0;
    std::vector<double> constraints;
};

/// Where a step of Gcmma led.
struct GcmmaStep {
    std::vector<double> x;
    MmaValues values;  ///< at x
    std::vector<double> lambda, y;
    double z = 0;
    int evaluations = 0;  ///< of the functions: one for each subproblem
    /// The approximations were not below the functions at x. If not, max_gcmma_evaluations was reached.
    bool is_conservative = false;
};

/// Most evaluations in a step: a first one and 15 inner iterations.
inline constexpr int max_gcmma_evaluations = 16;

/// As Mma, but a step is taken only once every approximation is at least the function there: else the
/// approximation becomes more convex and the subproblem is solved again (Svanberg, "A class of globally
/// convergent optimization methods based on conservative convex separable approximations", 2002; rules and
/// constants of "MMA and GCMMA", 2007). So with a feasible x, the next is feasible and no worse.
class Gcmma {
  public:
    using Evaluate = std::function<MmaValues(std::span<const double> x)>;

    /// Throws as the constructor of Mma does. `raa` of the options is not used.
    Gcmma(std::size_t variables, std::size_t constraints, MmaOptions options = {});

    /// Takes one step from a point where the objective's value is known. Throws as Mma::update does, and what
    /// `evaluate` throws; then the state is as before. Values that are not finite count as too large, unless
    /// the last ones are so: then throws FaultError.
    GcmmaStep update(const MmaPoint& point, double objective, const Evaluate& evaluate);
    void reset_asymptotes() { state_ = {}; }

    const MmaState& state() const { return state_; }
    /// Throws as Mma::set_state does.
    void set_state(MmaState state);

  private:
    std::size_t variables_;
    std::size_t constraints_;
    MmaOptions options_;
    MmaState state_;
};

}  // namespace lamella
