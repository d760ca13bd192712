// Makes gradings from the recipe's [[grading]] entries and graded numbers; the registry of their kinds.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>

#include "engine/base/error.h"
#include "engine/field/grading.h"
#include "engine/formula/formula.h"
#include "recipe/recipe.h"
#include "recipe/recipe_kinds.h"

namespace lamella {

class InputCache;

/// An InputError whose message already names the recipe's key.
struct LocatedError : InputError {
    using InputError::InputError;
};

/// A formula and the gradings that supply its inputs after x, y, z.
struct GradedFormula {
    Formula formula;
    std::vector<GradingPtr> others;
};

/// A graded number of the recipe, as requested and as made.
struct GradedUse {
    std::string key;  ///< "foam.cell"
    GradingPtr asked;
    GradingPtr made;  ///< clamped to the limits, and to the range in the part of what was asked
    Interval limits;
    std::string unit;  ///< of the numbers and limits: "mm"; empty for dimensionless ones
};

/// Returns a graded number where it is once the part is turned about the origin by orthogonal axes.
GradedUse turned(GradedUse use, const glm::dmat3& axes);

/// A number that replaces another one inside a region.
struct RegionalNumber {
    FieldPtr region;
    double blend;  ///< mm; see region_weight
    GradedNumber number;
};

/// The densities that [optimize] found.
struct SearchResult {
    GradingPtr density;  ///< above 0.5 is solid; of a foam its solid volume fraction
    FieldPtr dense;      ///< where it is above 0.5, in the body's bounds and beyond the body
};

/// The gradings of a recipe. Each is made, and its file read, on first use.
class Gradings {
  public:
    /// `inputs`: what former builds know of files; may be null.
    explicit Gradings(const Recipe& recipe, InputCache* inputs = nullptr)
        : recipe_(recipe), inputs_(inputs) {}

    /// Sets the body from whose surface depths are measured. Gradings that were made of former depths stay.
    void set_body(FieldPtr body);

    /// Sets the result of the recipe's search, which entries of kind `optimized` are.
    void set_result(SearchResult result) { result_ = std::move(result); }
    /// Throws InputError before set_result().
    const SearchResult& result() const;

    /// Makes a grading known to formulas under a name that the recipe does not define.
    void define(const std::string& name, GradingPtr grading) { made_[name] = std::move(grading); }

    /// Returns the grading of a number or formula. Names in `more` have precedence over the recipe's. Throws
    /// InputError when it needs something that is missing: a file, or a part from which depths are measured.
    GradingPtr resolve(const GradedNumber& number, const std::map<std::string, GradingPtr>& more = {});
    /// Returns a formula with its input gradings; `more` and errors as in `resolve`.
    GradedFormula formula_of(const GradedNumber& number, const std::map<std::string, GradingPtr>& more = {});

    /// Makes `graded` replace a key's number inside a region; where regions overlap, later ones win.
    void override_number(const std::string& key, RegionalNumber number);
    void forget_overrides() { overrides_.clear(); }
    /// Returns the overrides of a key.
    std::span<const RegionalNumber> overrides(const std::string& key) const;

    const Recipe& recipe() const { return recipe_; }
    InputCache* inputs() const { return inputs_; }
    /// Null before set_body.
    const FieldPtr& body() const { return body_; }

  private:
    GradingPtr named(const std::string& name);

    const Recipe& recipe_;
    InputCache* inputs_;
    FieldPtr body_;
    std::optional<SearchResult> result_;
    std::map<std::string, GradingPtr> made_;
    std::map<std::string, std::vector<RegionalNumber>> overrides_;
};

/// Returns a graded number with the overrides of regions, clamped to its limits and to its range in the part;
/// constants have been checked with the recipe. Where a formula is undefined, the result is the upper limit
/// if the recipe states one (below that of the settings table for `key`_max). Otherwise a formula that is
/// undefined at a sampled point of the body is an InputError; a formula that may be undefined between the
/// samples gets twice the greatest value found there.
GradedUse graded(const std::string& key, const GradedNumber& number, Interval limits, Gradings& gradings,
                 const std::map<std::string, GradingPtr>& more = {});

/// A kind of [[grading]]: its keys and its factory.
struct GradingBuilder {
    Kind kind;
    GradingPtr (*make)(const GradingRecipe&, Gradings&);
};
std::span<const GradingBuilder> grading_builders();

}  // namespace lamella
