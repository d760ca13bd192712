// GradedNumber: a number of a recipe that may be a formula.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>

#include "engine/base/geometry.h"

namespace lamella {

/// A number, or a formula that gives one at every point.
struct GradedNumber {
    std::variant<double, std::string> value{0.0};
    std::string where;  ///< its place, for messages: "foam.toml:7: foam.cell" or "--cell"

    bool is_formula() const { return value.index() == 1; }
    /// The number. Requires that it is not a formula.
    double number() const { return std::get<double>(value); }
    const std::string& formula() const { return std::get<std::string>(value); }
    /// Two are equal if their values are; places do not count.
    friend bool operator==(const GradedNumber& a, const GradedNumber& b) { return a.value == b.value; }
};

/// Three numbers, each of which may be a formula.
using GradedTriple = std::array<GradedNumber, 3>;

/// Returns the numbers of a triple; nothing when one is a formula.
std::optional<dvec3> constant(const GradedTriple& triple);

}  // namespace lamella
