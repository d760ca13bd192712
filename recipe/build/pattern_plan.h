// The plan of a skin's pattern by example: made once, kept under the hash of its inputs.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "procedural/pattern/surface_pattern.h"
#include "recipe/recipe.h"

namespace lamella {

/// Returns the hash of all that the pattern on the recipe's body depends on. `depth` (mm) is that of the
/// settings: regions, too, may make a skin thicker.
std::string pattern_hash(const Recipe& recipe, double depth);

/// Returns the pattern that the folder keeps for this recipe, or makes it and keeps it there. An empty folder
/// keeps nothing. Calls `on_synthesis`, which may be empty, before it makes one. Throws as
/// synthesise_on_surface().
SurfaceBricks pattern_plan(const Recipe& recipe, const Field& body, const SurfacePatternSettings& settings,
                           const std::filesystem::path& plans,
                           const std::function<void()>& on_synthesis = {});

}  // namespace lamella
