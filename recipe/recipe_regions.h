// Checks of a recipe's [[region]] entries.
#pragma once

#include <string>
#include <vector>

#include "recipe/recipe.h"

namespace lamella {

/// A number of a region that replaces another key's.
struct RegionNumber {
    std::string key;  ///< the key that it replaces: "foam.cell", "skin.thickness"
    const GradedNumber* number;
};

/// Returns the numbers that a region sets, without those that its kind does not use.
std::vector<RegionNumber> numbers_of(const RegionRecipe& region);

/// Returns the message for a name that is no [[field]]'s; empty when it is one's. `where` is its place.
std::string unknown_field(const Recipe& recipe, const std::string& where, const std::string& name);

/// Returns a message for each mistake in the regions: unknown fields, numbers that the foam does not have or
/// that are out of its limits, foam regions without a foam.
std::vector<std::string> region_mistakes(const Recipe& recipe);

}  // namespace lamella
