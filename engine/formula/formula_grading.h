// Gradings defined by formulas.
#pragma once

#include <vector>

#include "engine/field/grading.h"
#include "engine/formula/formula.h"

namespace lamella {

/// Returns the grading formula(x, y, z, others...): inputs 0 to 2 are the point (mm), others[i] feeds input 3
/// + i. Throws InputError when an input has no grading.
GradingPtr make_formula_grading(Formula formula, std::vector<GradingPtr> others);

}  // namespace lamella
