// Gradings are gone through until none is added, as they may use others that come later.
#include "recipe/result_dependents.h"

#include <algorithm>

#include "recipe/recipe_formulas.h"

namespace lamella {

namespace {

bool uses_one_of(const std::set<std::string>& names, const GradedNumber& number) {
    return number.is_formula() &&
           std::ranges::any_of(names_beyond_place(number.formula()),
                               [&](const std::string& name) { return names.contains(name); });
}

}  // namespace

ResultDependents::ResultDependents(const Recipe& recipe) {
    const auto add_grading = [&](const GradingRecipe& grading) {
        const bool depends = grading.kind == optimized_kind || uses_one_of(gradings, grading.formula) ||
                             uses_one_of(gradings, grading.along);
        return depends && gradings.insert(grading.name).second;
    };
    while (std::ranges::count_if(recipe.gradings, add_grading) > 0) {
    }
    for (const FieldRecipe& field : recipe.fields) {
        if (field.kind == optimized_kind || uses_one_of(gradings, field.formula)) fields.insert(field.name);
    }
}

}  // namespace lamella
