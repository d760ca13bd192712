// What analyses compute: the stiffness of a foam, the search of [optimize].
#pragma once

#include <memory>
#include <string>

#include "app/jobs/analysis.h"
#include "app/jobs/served_job.h"
#include "recipe/structure/foam_stiffness.h"

namespace lamella {

/// Returns the work that homogenises a job's foam. `options`: elements and samples. Its result is what
/// `lamella homogenize --json` says, with "directions" (directional_json) and "law" (law_json). Throws
/// InputError for a foam that cannot be homogenised.
std::function<void(Analysis&)> homogenize_work(std::shared_ptr<const ServedJob> job,
                                               StiffnessOptions options);

/// Returns the work that searches for the design of a recipe's text. Its result is what `lamella optimize
/// --json` says, also when it is cancelled after the first step. The design is kept with the plans, where the
/// job of the recipe finds it. `resume`: goes on where a search was cancelled. Throws RecipeMistakes, and
/// InputError for a recipe without [optimize].
std::function<void(Analysis&)> optimize_work(const std::string& text, const ServedFolder& folder, bool resume,
                                             int threads);

}  // namespace lamella
