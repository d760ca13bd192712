// Hollows a part as the recipe's [cavity] says, and builds the wall around the print of its [shield].
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "engine/layers/layer.h"
#include "engine/layers/layer_stream.h"
#include "engine/surveys/shield_survey.h"
#include "recipe/recipe.h"

namespace lamella {

/// Cavities that were made.
struct HollowReport {
    std::size_t count = 0;       ///< cavities
    double volume = 0;           ///< total, mm^3
    std::size_t left_solid = 0;  ///< cavities left out because they were too small
    double part_volume = 0;      ///< before hollowing, as surveyed, mm^3
};

/// Subtracts cavities from the designed job's part, after a survey of all layers. Lengths are as printed: the
/// scale of [process] is taken into account; `layer_height` is the least of the print. Throws InputError when
/// the settings do not suit the part.
HollowReport hollow_out(const Recipe& recipe, Job& designed, double layer_height);

nlohmann::ordered_json cavities_json(const HollowReport& cavities);

/// Returns one sentence: "2 of 120.5 mm3, 40.1 % of the part; 3 too small, left solid".
std::string cavities_text(const HollowReport& cavities);

struct ShieldWork {
    int threads = 0;                      ///< 0: one per core
    const CancelToken* cancel = nullptr;  ///< may be null
};

/// Adds a shield to the job's supports if the recipe asks for one. Surveys all layers; the job's bounds grow
/// to include it. Throws InputError when the settings do not suit the print, Interrupted when cancelled.
std::optional<ShieldSurvey> add_shield(const Recipe& recipe, Job& job, const ShieldWork& work);

/// Returns one sentence: "a wall of 120.5 mm3".
std::string shield_text(const ShieldSurvey& shield);

}  // namespace lamella
