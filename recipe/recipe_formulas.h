// Names and formulas of a recipe: what a formula may use, and what is wrong with those that use something
// else.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "recipe/recipe.h"

namespace lamella {

/// Names that formulas know besides the recipe's gradings: the place, mm; the depth below the part's surface,
/// mm; and, in the keys of a foam that follow foam.cell, the size of the cell there, mm.
inline constexpr std::string_view depth_name = "d";
inline constexpr std::string_view cell_name = "cell";

/// Names that a formula uses besides x, y and z, in order of first use. Throws InputError on a syntax error.
std::vector<std::string> names_beyond_place(std::string_view formula);

/// Gradings may build on gradings this many levels deep.
inline constexpr int deepest_grading = 16;

/// Everything that is wrong with a recipe's names and formulas, a message each: names that are none, are
/// taken or stand twice; syntax errors; unknown names; gradings that lead back to themselves; depths where
/// there is no surface yet.
std::vector<std::string> formula_mistakes(const Recipe& recipe);

/// The [[grading]] and [[field]] entries that the part is made without, as one sentence; empty when there are
/// none.
std::string unused_entries(const Recipe& recipe);

}  // namespace lamella
