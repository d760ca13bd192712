// A grading that is replaced by another one inside a region.
#pragma once

#include "engine/field/grading.h"

namespace lamella {

/// Returns the weight of a region where its field has the given value: 1 at depths of `width` / 2 or more
/// inside, 0 at `width` / 2 or more outside, smoothstep (3 t^2 - 2 t^3) between; a step at the border if the
/// width is 0. NaN is outside. `width` is in mm if the value is the distance (metric exact); if it is smaller
/// (bound), the transition is wider.
double region_weight(double value, double width);

/// Blends two gradings: exactly `inside` where the region's weight is 1, exactly `outside` where it is 0, and
/// their weighted mean between. Neither is evaluated where its weight is 0. Throws InputError for a null
/// argument, or a width that is negative or not finite.
GradingPtr make_region_grading(GradingPtr outside, GradingPtr inside, FieldPtr region, double width);

}  // namespace lamella
