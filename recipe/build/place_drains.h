// Drains: holes through the skin at the lowest points of closed cavities, and vents at the highest.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "engine/layers/layer.h"
#include "engine/surveys/cavity_survey.h"
#include "recipe/build/build_skin.h"

namespace lamella {

/// What a survey for cavities found, and what was drilled.
struct DrainReport {
    std::size_t cavities = 0;        ///< closed, before there were drains
    double volume = 0;               ///< of all, mm^3
    std::size_t small = 0;           ///< ... smaller than a ball of the drains' radius: left as they are
    std::vector<Cavity> drained;     ///< the others, the largest first
    std::vector<DrilledHole> holes;  ///< a drain for each, or a drain and a vent
};

/// Finds the closed cavities of the job, whose skin is at most `depth` mm thick, and where to drill them:
/// from the nearest point of the body's surface through the cavity's lowest point and, with two drains, its
/// highest. Throws InputError when the pitch of the recipe does not suit the part, and when there are more
/// than 1000 cavities to drain.
DrainReport place_drains(const Recipe& recipe, const Job& job, const Field& body, double depth);

nlohmann::ordered_json drains_json(const DrainReport& report);

/// One sentence.
std::string drains_text(const DrainReport& report);

}  // namespace lamella
