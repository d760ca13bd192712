// The result of an island survey as JSON and as a sentence.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "engine/surveys/island_survey.h"

namespace lamella {

/// Returns counts, volumes and the largest islands with their places.
nlohmann::ordered_json islands_json(const IslandReport& islands);

/// Returns one sentence: "3 of 0.12 mm3 float free, the largest, of 0.1 mm3, about (1, 2, 3) mm; ...".
std::string islands_text(const IslandReport& islands);

}  // namespace lamella
