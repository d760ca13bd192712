// Steps that need a pass over all layers: drop islands, repair, add supports and a shield.
#pragma once

#include <functional>
#include <optional>

#include "recipe/build/build_enclosure.h"
#include "recipe/build/build_supports.h"

namespace lamella {

struct FinishOptions {
    std::filesystem::path plans = default_plan_folder();  ///< folder for support plans; empty: none are kept
    int threads = 0;                                      ///< 0: one per core
    /// Receives the progress of the survey named "islands", "repairs" or "supports"; may be empty.
    std::function<void(const char* what, const Progress&)> on_progress{};
    const CancelToken* cancel = nullptr;  ///< may be null
};

/// Structures around the part. Changes of the part itself are recorded in the BuiltJob.
struct SupportStructures {
    std::optional<BuiltSupports> supports;
    std::optional<ShieldSurvey> shield;
};

/// Drops islands, repairs the part, adds supports and a shield, and assigns tools, in this order, each if the
/// recipe asks for it. Throws InputError when the settings do not suit the part, Interrupted when cancelled.
SupportStructures finish_job(const Recipe& recipe, BuiltJob& built, const FinishOptions& options);

}  // namespace lamella
