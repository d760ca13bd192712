// From what a user names as an input to a recipe.
#pragma once

#include <string>

#include "recipe/machine_profiles.h"
#include "recipe/recipe.h"
#include "recipe/recipe_draft.h"

namespace lamella {

/// Takes a recipe file (.toml), or anything else as the file of a model; nothing for "". Throws InputError
/// where a recipe cannot be read at all; other mistakes are collected.
void read_input(RecipeDraft& draft, const std::string& input);

/// The recipe of a file, or of a model without foam and skin. Throws InputError with all mistakes at once.
Recipe read_recipe(const std::string& input, const MachineProfiles& profiles);

/// The profiles that a run knows: those in `folder` (none when empty), then the user's, then the built-in
/// ones. Throws InputError when the folder does not exist.
MachineProfiles machine_profiles(const std::string& folder);

}  // namespace lamella
