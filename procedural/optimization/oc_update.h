// The optimality criteria update: least compliance under one volume constraint.
#pragma once

#include <functional>
#include <span>
#include <vector>

namespace lamella {

struct OcSettings {
    double move = 0.2;        ///< most change of a variable in a step
    double tolerance = 1e-3;  ///< of the bisection for the multiplier, relative
};

/// Returns how much a design exceeds the bound of its volume.
using VolumeExcess = std::function<double(std::span<const double> design)>;

/// Takes one step: x sqrt(-dC/dx / (lambda dV/dx)), within [lower, upper] and the move limit, lambda being
/// such that the volume meets its bound (Sigmund 2001, "A 99 line topology optimization code written in
/// Matlab", section 4). Variables whose volume gradient is not positive keep their value.
std::vector<double> oc_update(std::span<const double> x, std::span<const double> lower,
                              std::span<const double> upper, std::span<const double> compliance_gradient,
                              std::span<const double> volume_gradient, const VolumeExcess& excess,
                              const OcSettings& settings);

}  // namespace lamella
