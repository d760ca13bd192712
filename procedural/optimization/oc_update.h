// The optimality criteria update: least compliance under one volume constraint.
#pragma once

#include <span>
#include <vector>

namespace lamella {

/// One number a variable.
struct OcProblem {
    std::span<const double> x, lower, upper;  ///< x lies within the bounds
    std::span<const double> compliance_gradient, volume_gradient;
    double excess = 0;  ///< the present volume less its bound, in the unit of `volume_gradient` times x
};

struct OcSettings {
    double move = 0.2;        ///< most change of a variable in a step
    double tolerance = 1e-3;  ///< of the bisection for the multiplier, relative
};

/// Takes one step: x sqrt(-dC/dx / (lambda dV/dx)), within bounds and the move limit, lambda being such that
/// the volume meets its bound to first order (Sigmund 2001, "A 99 line topology optimization code written in
/// Matlab", section 4; exact for densities that are linear in x). Variables whose volume gradient is not
/// positive keep their value.
std::vector<double> oc_update(const OcProblem& problem, const OcSettings& settings);

}  // namespace lamella
