// The relative margin for rounding errors when two distances are compared.
#pragma once

namespace lamella {

/// A factor just above 1. A computed distance times this factor is never below the exact distance.
inline constexpr double rounding_margin = 1 + 1e-9;

}  // namespace lamella
