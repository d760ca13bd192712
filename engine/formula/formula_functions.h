// The functions and constants that the text of a formula can name.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "engine/formula/formula_builder.h"

namespace lamella {

struct FormulaFunction {
    std::string_view name;
    int least, most;  ///< number of arguments
    FormulaBuilder::Node (*make)(FormulaBuilder& builder, std::span<const FormulaBuilder::Node> arguments);
};

/// Returns all functions, sorted by name.
std::span<const FormulaFunction> formula_functions();
/// Returns the function of that name; null when there is none.
const FormulaFunction* find_formula_function(std::string_view name);
/// Returns the constant of that name: pi, e or tau.
std::optional<double> formula_constant(std::string_view name);

}  // namespace lamella
