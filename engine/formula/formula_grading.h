// Numbers that vary in space, written down as formulas.
#pragma once

#include <vector>

#include "engine/field/grading.h"
#include "engine/formula/formula.h"

namespace lamella {

/// The number formula(x, y, z, others...): inputs 0 to 2 are the point (mm), others[i] feeds input 3 + i. An
/// input without a grading is an InputError.
GradingPtr make_formula_grading(Formula formula, std::vector<GradingPtr> others);

}  // namespace lamella
