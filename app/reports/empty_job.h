// Jobs of which nothing is printed.
#pragma once

#include <string>

#include "engine/layers/layer_stream.h"
#include "recipe/recipe.h"

namespace lamella {

/// Returns the likely reason why a whole job printed nothing; empty if it printed something, or if only some
/// of its layers were made.
std::string empty_job_text(const Recipe& recipe, const Job& job, const StreamReport& report);

}  // namespace lamella
