// The entries of a recipe that are known only when its search has ended.
#pragma once

#include <set>
#include <string>
#include <string_view>

#include "recipe/recipe.h"

namespace lamella {

/// The kind of a [[field]] or [[grading]] that is the result of [optimize].
inline constexpr std::string_view optimized_kind = "optimized";

/// The names of the [[field]] and [[grading]] entries that are of kind `optimized`, or whose formulas use one
/// that is. Formulas must be free of syntax errors.
struct ResultDependents {
    explicit ResultDependents(const Recipe& recipe);

    std::set<std::string> fields, gradings;
};

}  // namespace lamella
