// Drains: holes through the skin at the lowest points of closed cavities, and vents at the highest.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "engine/layers/layer.h"
#include "engine/surveys/cavity_survey.h"
#include "recipe/build/build_skin.h"

namespace lamella {

/// Closed cavities found by a survey, and the holes drilled into them.
struct DrainReport {
    std::size_t cavities = 0;        ///< closed cavities before draining
    double volume = 0;               ///< of all cavities, mm^3
    std::size_t small = 0;           ///< cavities smaller than a ball of the drains' radius, which are not
                                     ///< drained
    std::vector<Cavity> drained;     ///< cavities with holes, the largest first
    std::vector<Cavity> kept;        ///< cavities from which no way out was found, the largest first
    std::vector<DrilledHole> holes;  ///< a drain for each, or a drain and a vent
};

/// Finds the closed cavities of the job, whose skin is at most `depth` mm thick, and places their holes: from
/// the nearest point of the body's surface through the cavity's lowest point and, with two drains, through
/// its highest. Where no point of the surface is the nearest one, as where shells of a mesh overlap, the hole
/// takes the shortest straight way out. Throws InputError when the recipe's pitch does not suit the part, and
/// when there are more than 1000 cavities to drain.
DrainReport place_drains(const Recipe& recipe, const Job& job, const Field& body, double depth);

nlohmann::ordered_json drains_json(const DrainReport& report);

/// Returns one sentence.
std::string drains_text(const DrainReport& report);

}  // namespace lamella
