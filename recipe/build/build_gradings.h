// From the recipe's [[grading]] entries and graded numbers to gradings.
#pragma once

#include <map>
#include <span>
#include <string>

#include "engine/base/error.h"
#include "engine/field/grading.h"
#include "engine/formula/formula.h"
#include "recipe/recipe.h"
#include "recipe/recipe_kinds.h"

namespace lamella {

/// A message that says already which key of the recipe it is about.
struct LocatedError : InputError {
    using InputError::InputError;
};

/// A formula with the gradings that feed its inputs after x, y, z.
struct GradedFormula {
    Formula formula;
    std::vector<GradingPtr> others;
};

/// A number of the recipe that may vary in space, as it is asked for and as it is made.
struct GradedUse {
    std::string key;  ///< "foam.cell"
    GradingPtr asked;
    GradingPtr made;  ///< kept within limits
    Interval limits;
    std::string unit;  ///< of the numbers and limits: "mm", or empty for what has none
};

/// A number that holds instead of another one inside a region.
struct RegionalNumber {
    FieldPtr region;
    double blend;  ///< mm; see region_weight
    GradedNumber number;
};

/// The gradings of a recipe. Each is made, and its file read, when it is first asked for.
class Gradings {
  public:
    explicit Gradings(const Recipe& recipe) : recipe_(recipe) {}

    /// From here on there is a body to measure depths from.
    void set_body(FieldPtr body) { body_ = std::move(body); }

    /// A number or formula of the recipe. Names in `more` come before the recipe's. Throws InputError for
    /// what it needs and cannot be had: a file, or a part to measure depths from.
    GradingPtr resolve(const GradedNumber& number, const std::map<std::string, GradingPtr>& more = {});
    /// A formula with what it needs.
    GradedFormula formula_of(const GradedNumber& number, const std::map<std::string, GradingPtr>& more = {});

    /// From here on `graded` gives a key another number in a region; of several, later ones win.
    void override_number(const std::string& key, RegionalNumber number);
    /// Those of a key.
    std::span<const RegionalNumber> overrides(const std::string& key) const;

    const Recipe& recipe() const { return recipe_; }
    /// Null as long as there is no body.
    const FieldPtr& body() const { return body_; }

  private:
    GradingPtr named(const std::string& name);

    const Recipe& recipe_;
    FieldPtr body_;
    std::map<std::string, GradingPtr> made_;
    std::map<std::string, std::vector<RegionalNumber>> overrides_;
};

/// A graded number, with those of regions in its place, within its limits; constants have been checked with
/// the recipe. Where it has no number, it gets the upper limit, if the recipe states one (below that of the
/// settings table for `key`_max). If not, a formula that has no number somewhere in the body is an
/// InputError; and one that may lack it between the points looked at gets twice the greatest number found
/// there.
GradedUse graded(const std::string& key, const GradedNumber& number, Interval limits, Gradings& gradings,
                 const std::map<std::string, GradingPtr>& more = {});

/// A kind of [[grading]]: its keys, and how it is made.
struct GradingBuilder {
    Kind kind;
    GradingPtr (*make)(const GradingRecipe&, Gradings&);
};
std::span<const GradingBuilder> grading_builders();

}  // namespace lamella
