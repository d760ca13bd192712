// Sampling lines at fixed places in the plane, so that a result does not depend on the rectangle asked for.
#pragma once

#include "engine/base/geometry.h"
#include "engine/runs/runs.h"

namespace lamella {

/// Returns the lines along an axis that meet a rectangle, and their pixels in it. They lie at multiples of
/// the pitch (mm) plus an odd fraction, so that borders at round coordinates do not run along them. Throws
/// InputError when the rectangle reaches more than 2^20 pitches from the origin or is unbounded.
RowBand plane_lattice(Axis axis, const Rect& rect, double pitch);

}  // namespace lamella
