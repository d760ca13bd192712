// From a recipe's [cavity] to a hollow part, and from its [shield] to a wall about the print.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "engine/layers/layer.h"
#include "engine/layers/layer_stream.h"
#include "engine/surveys/shield_survey.h"
#include "recipe/recipe.h"

namespace lamella {

/// What was made hollow.
struct HollowReport {
    std::size_t count = 0;       ///< cavities
    double volume = 0;           ///< of them all, mm^3
    std::size_t left_solid = 0;  ///< cavities that were too small
    double part_volume = 0;      ///< before, as surveyed, mm^3
};

/// Takes cavities from the part of the designed job, all of whose layers are surveyed for it. Lengths hold as
/// printed: what [process] scales is taken into account. Throws InputError when the settings do not suit the
/// part.
HollowReport hollow_out(const Recipe& recipe, Job& designed);

nlohmann::ordered_json cavities_json(const HollowReport& cavities);

/// "2 of 120.5 mm3, 40.1 % of the part; 3 too small, left solid": one sentence.
std::string cavities_text(const HollowReport& cavities);

struct ShieldWork {
    int threads = 0;                      ///< 0: one per core
    const CancelToken* cancel = nullptr;  ///< may be null
};

/// Gives the job a shield besides its supports, where the recipe asks for one: all layers are surveyed, and
/// the job's bounds grow by it. Throws InputError when the settings do not suit the print, Interrupted when
/// cancelled.
std::optional<ShieldSurvey> add_shield(const Recipe& recipe, Job& job, const ShieldWork& work);

/// "a wall of 120.5 mm3": one sentence.
std::string shield_text(const ShieldSurvey& shield);

}  // namespace lamella
