// What an island survey found, for people and for programs.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "engine/surveys/island_survey.h"

namespace lamella {

/// Counts, volumes and the largest islands with their places.
nlohmann::ordered_json islands_json(const IslandReport& islands);

/// "3 of 0.12 mm3 float free, the largest, of 0.1 mm3, about (1, 2, 3) mm; ...": one sentence.
std::string islands_text(const IslandReport& islands);

}  // namespace lamella
