// Writes the orientation of a part into its recipe.
#pragma once

#include <string>

#include "engine/base/geometry.h"

namespace lamella {

/// Returns a direction as the recipe and --lay-on take it: "0.0000,0.6000,-0.8000", whole numbers where it is
/// along an axis.
std::string lay_on_text(dvec3 direction);

/// Throws InputError for a file that is no recipe.
void check_is_recipe(const std::string& recipe);

/// Sets part.lay_on in a recipe file and removes part.turn and part.lay_on_at; all other lines stay as they
/// are. The file is replaced at once. Throws InputError for a recipe whose [part] is not a table with one key
/// a line.
void write_orientation(const std::string& recipe, dvec3 lay_on);

}  // namespace lamella
