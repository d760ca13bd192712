// Solids that are written down as formulas.
#pragma once

#include <vector>

#include "engine/field/field.h"
#include "engine/field/grading.h"
#include "engine/formula/formula.h"

namespace lamella {

/// The solid where formula(x, y, z, others...) < 0, within bounds (a finite box; outside it there is
/// nothing). others[i] feeds input 3 + i. `metric` is what the caller vouches for. An input without a
/// grading, or a box that is empty or not finite, is an InputError.
FieldPtr make_formula_field(const Formula& formula, std::vector<GradingPtr> others, const Box& bounds,
                            Metric metric = Metric::sign);

/// A box that surely holds the solid, found by excluding by intervals from +-10,000 mm. InputError when the
/// solid is empty, or reaches out of that cube.
Box formula_bounds(const Formula& formula, std::span<const GradingPtr> others);

}  // namespace lamella
