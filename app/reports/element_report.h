// Discrete elements in words and as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "procedural/elements/element_plan.h"

namespace lamella {

nlohmann::ordered_json elements_json(const ElementPlan& plan);

/// Returns "100 in one piece, 31.2 % of the part; ..." without a line's end.
std::string elements_text(const ElementPlan& plan);

}  // namespace lamella
