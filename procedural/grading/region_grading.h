// A grading that gives way to another one inside a region.
#pragma once

#include "engine/field/grading.h"

namespace lamella {

/// How much a region counts where its field has this value: 1 from `width` / 2 inside its border on, 0 from
/// `width` / 2 outside on, smoothstep (3 t^2 - 2 t^3) between; a step at the border where the width is 0. NaN
/// is outside. The width is in mm where the value is the distance (metric exact); where it is less (bound),
/// the change takes more room.
double region_weight(double value, double width);

/// `inside` where the region's weight is 1, `outside` where it is 0, exactly; between, the mean of both by
/// the weight. Neither is asked where it does not count. Throws InputError for something missing, or a width
/// that is negative or not finite.
GradingPtr make_region_grading(GradingPtr outside, GradingPtr inside, FieldPtr region, double width);

}  // namespace lamella
