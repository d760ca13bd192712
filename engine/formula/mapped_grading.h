// Grading read at a position that formulas compute.
#pragma once

#include <array>
#include <vector>

#include "engine/field/grading.h"
#include "engine/formula/formula.h"

namespace lamella {

/// Returns the value of `inner` at the position (x, y, z) that the formulas compute for a point; NaN where
/// one of them is NaN. Inputs 0 to 2 are the point, mm; others[i] feeds input 3 + i. The position has the
/// unit that `inner` expects.
GradingPtr make_mapped_grading(GradingPtr inner, std::array<Formula, 3> place,
                               std::vector<GradingPtr> others);

}  // namespace lamella
