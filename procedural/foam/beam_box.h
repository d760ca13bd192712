// Intersection test of a beam and a box.
#pragma once

#include "engine/solids/beam.h"

namespace lamella {

/// Returns whether the closed beam and the closed box have a point in common. Exact up to rounding: the
/// distance from the box to the ball that sweeps the beam is a convex function along the axis, and its
/// minimum is found to 2^-60.
bool touches(const Beam& beam, const Box& box);

}  // namespace lamella
