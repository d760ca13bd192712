// From a job to what holds it up while it is printed: survey, scaffold, and the field of both.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "recipe/build/build_job.h"
#include "recipe/build/support_plan.h"

namespace lamella {

struct SupportOptions : PassControl {
    std::filesystem::path plans = default_plan_folder();  ///< where plans are kept; empty: nowhere
};

struct BuiltSupports {
    SupportPlan plan;
    FieldPtr before_offsets;   ///< the supports of the part before its outlines are moved; null for none
    bool was_planned = false;  ///< by an earlier run
};

/// Gives the job its supports, where the recipe asks for them: what would hang is surveyed, bridges and
/// pillars are found for it, and the job's bounds grow by them. A part under a closed skin, or without foam
/// and skin, is surveyed by its outer surface. Of others, bare foams and skins with windows, the layers
/// themselves are surveyed, and what lies more than a millimetre below the body's surface is left to hold
/// itself.
///
/// With a lift, the bed comes to lie so far below the part, rounded up to whole layers. Throws InputError
/// when the settings do not suit the part, Interrupted when cancelled.
std::optional<BuiltSupports> add_supports(const Recipe& recipe, BuiltJob& built,
                                          const SupportOptions& options);

/// The number of layers by which add_supports will raise the part: its lift, rounded up.
int lifted_layers(const Recipe& recipe, const Job& job);

/// "84 points on 10 bridges, 11 pillars": one line, and one for each thing that is amiss.
std::string supports_text(const BuiltSupports& supports);

}  // namespace lamella
