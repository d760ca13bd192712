// Checks of the names and formulas of a recipe.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "recipe/recipe.h"

namespace lamella {

/// Names that formulas may use besides the recipe's gradings and x, y, z: `d`, the depth below the part's
/// surface, mm; and, in the keys of a foam that follow foam.cell, `cell`, the local cell size, mm.
inline constexpr std::string_view depth_name = "d";
inline constexpr std::string_view cell_name = "cell";

/// Returns the names that a formula uses besides x, y and z, in order of first use. Throws InputError on a
/// syntax error.
std::vector<std::string> names_beyond_place(std::string_view formula);

/// The deepest chain of gradings that use other gradings.
inline constexpr int deepest_grading = 16;

/// Returns a message for each mistake in a recipe's names and formulas: invalid, reserved and repeated names;
/// syntax errors; unknown names; gradings that depend on themselves; depths used before the surface exists.
std::vector<std::string> formula_mistakes(const Recipe& recipe);

/// Returns the messages for syntax errors and unknown names in formulas alone, for a recipe with other
/// mistakes.
std::vector<std::string> formula_text_mistakes(const Recipe& recipe);

/// Returns true if a formula of the recipe uses the depth `d`.
bool uses_depth(const Recipe& recipe);

/// Returns a sentence that lists the [[grading]] and [[field]] entries that nothing uses; empty when there
/// are none.
std::string unused_entries(const Recipe& recipe);

}  // namespace lamella
