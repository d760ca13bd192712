// Solids defined by formulas.
#pragma once

#include <vector>

#include "engine/field/field.h"
#include "engine/field/grading.h"
#include "engine/formula/formula.h"

namespace lamella {

/// Returns the solid where formula(x, y, z, others...) < 0, within bounds (a finite box; the solid is empty
/// outside it). others[i] feeds input 3 + i. `metric` is a promise of the caller. Throws InputError when an
/// input has no grading, or the box is empty or not finite.
FieldPtr make_formula_field(const Formula& formula, std::vector<GradingPtr> others, const Box& bounds,
                            Metric metric = Metric::sign);

/// Returns a box that surely encloses the solid, found by interval exclusion within +-10,000 mm. Throws
/// InputError when the solid is empty or extends beyond that cube.
Box formula_bounds(const Formula& formula, std::span<const GradingPtr> others);

}  // namespace lamella
