// Reading of inputs: recipe files and models.
#pragma once

#include <string>

#include "recipe/machine_profiles.h"
#include "recipe/recipe.h"
#include "recipe/recipe_draft.h"

namespace lamella {

/// Adds an input to a draft: a recipe file (.toml), or any other file as a model; does nothing for "". Throws
/// InputError when a recipe cannot be read at all; other mistakes are collected.
void read_input(RecipeDraft& draft, const std::string& input);

/// Returns the recipe of a file, or one for a model without foam and skin. Throws InputError with all
/// mistakes at once.
Recipe read_recipe(const std::string& input, const MachineProfiles& profiles);

/// Returns the profiles of a run: those in `folder` (none when empty), then the user's, then the built-in
/// ones. Throws InputError when `folder` does not exist.
MachineProfiles machine_profiles(const std::string& folder);

}  // namespace lamella
