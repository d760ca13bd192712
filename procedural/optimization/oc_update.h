// The optimality criteria update: least compliance under one volume constraint.
#pragma once

#include <span>
#include <vector>

namespace lamella {

struct OcSettings {
    double move = 0.2;        ///< most change of a variable in a step
    double tolerance = 1e-3;  ///< of the bisection for the multiplier, relative
};

/// Takes one step: x sqrt(-dC/dx / (lambda dV/dx)), within [0, 1] and the move limit, lambda being such that
/// the volume meets its bound to first order (Sigmund 2001, "A 99 line topology optimization code written in
/// Matlab", section 4; exact for densities that are linear in x). Variables whose volume gradient is not
/// positive keep their value. `excess` is the present volume less its bound, in the unit of `volume_gradient`
/// times x.
std::vector<double> oc_update(std::span<const double> x, std::span<const double> compliance_gradient,
                              std::span<const double> volume_gradient, double excess,
                              const OcSettings& settings);

}  // namespace lamella
