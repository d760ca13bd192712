// Reports of optimisations and analyses, as text and JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "recipe/recipe.h"
#include "recipe/structure/structure_report.h"

namespace lamella {

/// Throws InputError unless the recipe has [optimize].
void check_is_optimized(const Recipe& recipe);

std::string structure_text(const StructureReport& report);
nlohmann::ordered_json structure_json(const StructureReport& report);

/// Returns a step as the report's history has it.
nlohmann::ordered_json step_json(const OptimizationStep& step);

/// Returns one line about a step: "40/100  C 12.3 N mm  volume 30.0 %  change 0.043  21.0 % grey", with a
/// picture "40/120  A 9.87  C 1.20 times the least  volume ...".
std::string step_text(const OptimizationStep& step, int steps);

}  // namespace lamella
