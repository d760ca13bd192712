// Colours for a foam's predicted modulus and its deviation from the request.
#pragma once

#include <functional>
#include <string>

#include "recipe/build/modulus_report.h"

namespace lamella {

/// Returns a colour map (linear light): dark blue to yellow from the least predicted modulus to the greatest,
/// on a logarithmic scale; red where the foam is softer than requested, white where it is stiffer.
std::function<dvec3(dvec3)> modulus_paint(const BuiltModulus& modulus, const ModulusReport& report);

/// Returns the legend of the colours, one line.
std::string modulus_legend(const ModulusReport& report);

}  // namespace lamella
