// The largest shape within given densities that a machine can print from the bottom up without supports.
#pragma once

#include "procedural/optimization/density_shape.h"

namespace lamella {

/// Returns densities on a refined() grid that are linear in a distance g to the shape's contour in each layer
/// of elements, 0.5 on it: 0.5 - g / 6, g in elements, clamped to 3 and negative inside. From a layer to the
/// next, g falls by at most `slope` elements everywhere:
///
///     g(k) = max(distance to the contour of {max(distance(k), g(k - 1) - slope) < 0}, g(k - 1) - slope)
///
/// so the shape stands out by at most that much, between layers of elements as well, at any level: this is
/// the largest such shape. It is made on the given grid, where means over neighbours round the steps of
/// elements and keep the inequality, and again on the refined one: where members meet above a gap, trilinear
/// values are right to an element only.
///
/// The lowest layer lies on the plate; prescribed solid elements stay. `level` is that of the given shape.
/// Layers are along z, lowest first. (The filter of Langelaar 2017, see overhang_filter.h, does the same for
/// whole elements.)
DensityGrid with_limited_overhang(const DensityGrid& grid, double volume, int factor, double slope = 1);

}  // namespace lamella
