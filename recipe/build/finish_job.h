// Steps that need a pass over all layers: drop islands, repair, add supports and a shield.
#pragma once

#include <functional>
#include <optional>

#include "recipe/build/build_enclosure.h"
#include "recipe/build/build_supports.h"

namespace lamella {

struct FinishOptions {
    std::filesystem::path plans =
        default_plan_folder();  ///< where plans of supports are kept; empty: nowhere
    int threads = 0;            ///< 0: one per core
    /// How far the survey for "islands", "repairs" or "supports" has come; may be empty.
    std::function<void(const char* what, const Progress&)> on_progress{};
    const CancelToken* cancel = nullptr;  ///< may be null
};

/// What stands about the part; what was done to the part itself stands in the BuiltJob.
struct SupportStructures {
    std::optional<BuiltSupports> supports;
    std::optional<ShieldSurvey> shield;
};

/// Leaves out islands, repairs the part, holds it up and shields it, in this order and each where the recipe
/// asks for it. Throws InputError where the settings do not suit the part, Interrupted when cancelled.
SupportStructures finish_job(const Recipe& recipe, BuiltJob& built, const FinishOptions& options);

}  // namespace lamella
