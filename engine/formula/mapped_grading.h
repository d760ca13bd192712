// A grading read somewhere else: at a place that formulas work out.
#pragma once

#include <array>
#include <vector>

#include "engine/field/grading.h"
#include "engine/formula/formula.h"

namespace lamella {

/// The number of `inner` at the place (x, y, z) that the formulas give for a point; NaN where one of them is.
/// Inputs 0 to 2 are the point, mm, others[i] feeds input 3 + i; the place is in whatever unit `inner` takes.
GradingPtr make_mapped_grading(GradingPtr inner, std::array<Formula, 3> place,
                               std::vector<GradingPtr> others);

}  // namespace lamella
