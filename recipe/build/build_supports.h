// Builds the supports of a job: overhang survey, scaffold, and the field of the scaffold.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "recipe/build/build_job.h"
#include "recipe/build/support_plan.h"

namespace lamella {

struct SupportOptions : PassControl {
    std::filesystem::path plans = default_plan_folder();  ///< folder for plans; empty: none are kept
};

struct BuiltSupports {
    SupportPlan plan;
    FieldPtr before_offsets;   ///< supports of the part before in-plane offsets; null for none
    bool was_planned = false;  ///< the plan was read from an earlier run
};

/// Adds supports to the job if the recipe asks for them: surveys overhangs, plans bridges and pillars, and
/// enlarges the job's bounds. A part under a closed skin, or without foam and skin, is surveyed by its outer
/// surface. Bare foams and skins with windows are surveyed by their layers; overhangs more than a millimetre
/// below the body's surface are not supported.
///
/// With a lift, the bed lies that far below the part, rounded up to whole layers. Throws InputError when the
/// settings do not suit the part, Interrupted when cancelled.
std::optional<BuiltSupports> add_supports(const Recipe& recipe, BuiltJob& built,
                                          const SupportOptions& options);

/// Returns the material of the supports, mm^3: their runs, 0.2 mm apart, on every layer.
double support_volume(const Job& job);

/// Returns a line such as "84 points on 10 bridges, 11 pillars", and one line for each problem.
std::string supports_text(const BuiltSupports& supports);

}  // namespace lamella
