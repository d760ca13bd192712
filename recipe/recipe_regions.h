// The rules of a recipe's [[region]] entries.
#pragma once

#include <string>
#include <vector>

#include "recipe/recipe.h"

namespace lamella {

/// A number of a region that takes the place of another key's.
struct RegionNumber {
    std::string key;  ///< of the number that it replaces: "foam.cell", "skin.thickness"
    const GradedNumber* number;
};

/// The numbers that a region gives, those of other kinds of regions left out.
std::vector<RegionNumber> numbers_of(const RegionRecipe& region);

/// Everything that is wrong with the regions, a message each: unknown fields, numbers that the foam does not
/// have or that lie outside its limits, regions of foam where there is none.
std::vector<std::string> region_mistakes(const Recipe& recipe);

}  // namespace lamella
