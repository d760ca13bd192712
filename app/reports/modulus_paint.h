// Colours for how stiff a foam gets, and for where it does not get as stiff as asked.
#pragma once

#include <functional>
#include <string>

#include "recipe/build/modulus_report.h"

namespace lamella {

/// A colour (linear light) at every point: dark blue to yellow from the least modulus that is predicted to
/// the greatest, by its logarithm; red where the foam gets softer than asked, white where it gets stiffer.
std::function<dvec3(dvec3)> modulus_paint(const BuiltModulus& modulus, const ModulusReport& report);

/// What the colours mean, a line.
std::string modulus_legend(const ModulusReport& report);

}  // namespace lamella
