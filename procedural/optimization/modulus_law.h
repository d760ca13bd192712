// ModulusLaw: the stiffness of an element as a function of its density.
#pragma once

#include <memory>

#include "procedural/elasticity/foam_law.h"

namespace lamella {

/// Young's modulus over that of the solid, for densities from 0 to 1. Results have the same bits on every
/// machine.
class ModulusLaw {
  public:
    virtual ~ModulusLaw() = default;
    virtual double modulus(double density) const = 0;
    /// Returns the derivative of modulus().
    virtual double slope(double density) const = 0;
};

struct PenaltySettings {
    double exponent = 3;   ///< p >= 1: makes intermediate densities too soft to be worth their volume
    double least = 1e-6;   ///< modulus of a void element: keeps the equations solvable
    double linear_to = 0;  ///< density below which the modulus is linear, so that self-weight stays carried
};

/// Makes the law least + density^exponent (1 - least) (modified SIMP; Andreassen et al. 2011, "Efficient
/// topology optimization in MATLAB using 88 lines of code", equation 1). Below `linear_to` density times
/// linear_to^(exponent - 1) stands in for the power (Pedersen 2000). Throws InputError for an exponent below
/// 1 and for shares outside [0, 1).
std::shared_ptr<const ModulusLaw> make_penalty_law(const PenaltySettings& settings);

/// Makes the law of a printable foam: relative modulus over density through the computed points of the
/// foam's law, power laws along a monotone cubic of the logarithms. Beyond the range of that law, the last
/// piece goes on down to `least`, and a further one leads up to the solid. Throws InputError if density or
/// modulus does not increase.
std::shared_ptr<const ModulusLaw> make_foam_modulus_law(const FoamLaw& law, double least);

}  // namespace lamella
