// Lines that stand fixed in the plane, so that what is found on them is the same from wherever it is asked.
#pragma once

#include "engine/base/geometry.h"
#include "engine/runs/runs.h"

namespace lamella {

/// The lines along an axis that meet a rectangle, and their pixels in it. They stand on multiples of the
/// pitch (mm) plus an odd fraction, so that borders at round coordinates do not run along them. Throws
/// InputError where there would be too many of them from the origin on, as where the rectangle has no end.
RowBand plane_lattice(Axis axis, const Rect& rect, double pitch);

}  // namespace lamella
