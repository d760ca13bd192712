// Reports of optimisations and analyses, as text and JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "recipe/structure/structure_report.h"

namespace lamella {

std::string structure_text(const StructureReport& report);
nlohmann::ordered_json structure_json(const StructureReport& report);

/// Returns one line about a step: "40/100  C 12.3 N mm  volume 30.0 %  change 0.043  21.0 % grey", with a
/// picture "40/120  A 9.87  C 1.20 times the least  volume ...".
std::string step_text(const OptimizationStep& step, int steps);

}  // namespace lamella
