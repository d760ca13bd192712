// The margin that covers the rounding of the few operations between two distances that are compared.
#pragma once

namespace lamella {

/// A factor just above 1: a distance times this is surely no less than the exact one.
inline constexpr double rounding_margin = 1 + 1e-9;

}  // namespace lamella
