// How far densities are from solid and void.
#pragma once

#include <span>

#include "procedural/optimization/element_use.h"

namespace lamella {

/// Returns the mean of 4 rho (1 - rho) over free elements (Sigmund 2007): 0 for solid and void, 1 for
/// densities of 0.5. One density an element; there must be a free one.
double greyness(std::span<const ElementUse> use, std::span<const double> density);

}  // namespace lamella
