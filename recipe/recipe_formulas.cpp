// Checks names first, then every formula alone, then the dependencies between gradings.
#include "recipe/recipe_formulas.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>

#include "engine/base/error.h"
#include "engine/formula/formula_functions.h"
#include "engine/formula/formula_parser.h"
#include "recipe/recipe_regions.h"
#include "recipe/settings.h"

namespace lamella {

namespace {

constexpr std::array<std::string_view, 3> place_names{"x", "y", "z"};

bool is_identifier(std::string_view name) {
    const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
    const auto digit = [](char c) { return c >= '0' && c <= '9'; };
    return !name.empty() && name.size() <= 64 && letter(name.front()) &&
           std::all_of(name.begin(), name.end(), [&](char c) { return letter(c) || digit(c); });
}

/// Returns the existing meaning of a name in formulas; empty when it is free.
std::string taken_by(std::string_view name) {
    if (std::find(place_names.begin(), place_names.end(), name) != place_names.end()) return "a coordinate";
    if (name == depth_name) return "the depth below the surface";
    if (name == cell_name) return "the size of the foam's cell";
    if (name == "and" || name == "or" || name == "not") return "an operator";
    if (find_formula_function(name)) return "a function";
    if (formula_constant(name)) return "a constant";
    return "";
}

/// A formula of the recipe and the names that it may use in addition to gradings.
struct Use {
    const GradedNumber* number;
    bool depth = true;
    bool cell = false;
};

/// Returns all numbers of a foam that may be formulas.
std::vector<const GradedNumber*> numbers_of(const FoamRecipe& foam) {
    std::vector<const GradedNumber*> numbers{&foam.cell, &foam.beam, &foam.wall, &foam.window, &foam.modulus};
    for (const GradedTriple* triple : {&foam.stretch, &foam.turn}) {
        for (const GradedNumber& number : *triple) numbers.push_back(&number);
    }
    return numbers;
}

/// Returns all numbers of regions, foam, frame, skin and elements that may be formulas.
std::vector<const GradedNumber*> numbers_of(const Recipe& recipe) {
    std::vector<const GradedNumber*> numbers;
    for (const RegionRecipe& region : recipe.regions) {
        for (const RegionNumber& given : numbers_of(region)) numbers.push_back(given.number);
    }
    if (recipe.foam) {
        for (const GradedNumber* number : numbers_of(*recipe.foam)) numbers.push_back(number);
    }
    if (recipe.frame) numbers.push_back(&recipe.frame->beam);
    if (const auto& skin = recipe.skin)
        numbers.insert(numbers.end(),
                       {&skin->thickness, &skin->strut, &skin->image_size, &skin->second_weight});
    if (const auto& elements = recipe.elements) {
        numbers.push_back(&elements->density);
        for (const GradedNumber& number : elements->along) numbers.push_back(&number);
    }
    return numbers;
}

bool uses_name(std::string_view formula, std::string_view name) {
    const std::vector<std::string> names = names_beyond_place(formula);
    return std::ranges::find(names, name) != names.end();
}

/// Members, windows and stretch factors may depend on the cell size, except where a modulus determines it.
bool may_use_cell(const FoamRecipe& foam, const GradedNumber& number) {
    if (&number == &foam.cell || &number == &foam.modulus) return false;
    const bool cell_is_solved = !foam.cell.is_formula() && foam.cell.number() == 0;
    return !cell_is_solved || (&number != &foam.beam && &number != &foam.wall);
}

/// Checks the names and formulas of one recipe.
class FormulaCheck {
  public:
    explicit FormulaCheck(const Recipe& recipe) : recipe_(recipe) {}

    std::vector<std::string> run() {
        check_names("field", recipe_.fields);
        check_names("grading", recipe_.gradings);
        check_body_name();
        if (!mistakes_.empty()) return std::move(mistakes_);
        check_formulas();
        if (mistakes_.empty()) check_order();
        if (mistakes_.empty()) check_field_depths();
        return std::move(mistakes_);
    }

    std::vector<std::string> run_on_texts() {
        check_formulas();
        return std::move(mistakes_);
    }

  private:
    void refuse(const std::string& where, const std::string& wrong, const std::string& right) {
        mistakes_.push_back(fmt::format("{}: {}; accepted: {}", where, wrong, right));
    }

    template <typename Entry>
    void check_names(const std::string& section, const std::vector<Entry>& entries) {
        std::map<std::string, std::string> seen;
        for (const Entry& entry : entries) {
            const std::string where = entry.where + ".name";
            const std::string taken = taken_by(entry.name);
            if (!is_identifier(entry.name)) {
                refuse(where, fmt::format("\"{}\" is not a valid name", entry.name.substr(0, 64)),
                       "up to 64 letters, digits and _, not beginning with a digit");
            } else if (!taken.empty()) {
                refuse(where, fmt::format("`{}` is reserved: it means {} in formulas", entry.name, taken),
                       "another name");
            } else if (const auto [first, fresh] = seen.emplace(entry.name, entry.where); !fresh) {
                refuse(where,
                       fmt::format("`{}` is the name of another [[{}]] ({})", entry.name, section,
                                   first->second),
                       "a unique name");
            }
        }
    }

    void check_body_name() {
        const std::string& name = recipe_.part.field;
        if (name.empty()) return;
        if (std::string wrong = unknown_field(recipe_, "part.field", name); !wrong.empty())
            mistakes_.push_back(std::move(wrong));
    }

    void check_formulas() {
        for (const FieldRecipe& field : recipe_.fields) check_formula({&field.formula, false});
        for (const GradingRecipe& grading : recipe_.gradings) {
            check_formula({&grading.formula});
            check_formula({&grading.along});
        }
        if (recipe_.foam) {
            for (const GradedNumber* number : numbers_of(*recipe_.foam)) {
                check_formula({number, true, may_use_cell(*recipe_.foam, *number)});
            }
        }
        if (recipe_.frame) check_formula({&recipe_.frame->beam, true, true});
        if (recipe_.skin) {
            check_formula({&recipe_.skin->thickness});
            check_formula({&recipe_.skin->strut});
            check_formula({&recipe_.skin->image_size});
            check_formula({&recipe_.skin->second_weight});
        }
        if (recipe_.elements) {
            check_formula({&recipe_.elements->density});
            for (const GradedNumber& number : recipe_.elements->along) check_formula({&number});
        }
        for (const RegionRecipe& region : recipe_.regions) {
            for (const RegionNumber& given : numbers_of(region)) {
                const bool may_use_cell = given.number != &region.cell && given.number != &region.modulus &&
                                          given.number != &region.thickness;
                check_formula({given.number, true, may_use_cell});
            }
        }
    }

    void check_formula(const Use& use) {
        if (!use.number->is_formula()) return;
        const std::string& text = use.number->formula();
        std::vector<std::string> known(place_names.begin(), place_names.end());
        if (use.depth) known.emplace_back(depth_name);
        if (use.cell) known.emplace_back(cell_name);
        for (const GradingRecipe& grading : recipe_.gradings) known.push_back(grading.name);
        try {
            if (!use.depth && uses_name(text, depth_name)) {
                return refuse(use.number->where,
                              "uses the depth `d` below the surface, but defines that surface itself",
                              "x, y, z and gradings");
            }
            parse_formula(text, known);
        } catch (const InputError& error) {
            mistakes_.push_back(use.number->where + ": " + error.what());
        }
    }

    /// Returns the gradings and depths that a grading depends on.
    static std::vector<std::string> needs(const GradingRecipe& grading) {
        std::vector<std::string> names;
        for (const GradedNumber* number : {&grading.formula, &grading.along}) {
            if (!number->is_formula()) continue;
            for (std::string& name : names_beyond_place(number->formula())) names.push_back(std::move(name));
        }
        return names;
    }

    const GradingRecipe* grading(const std::string& name) const {
        for (const GradingRecipe& known : recipe_.gradings) {
            if (known.name == name) return &known;
        }
        return nullptr;
    }

    /// Facts about a grading whose dependencies have been followed.
    struct Followed {
        int levels = 0;      ///< levels of gradings, including this one
        bool depth = false;  ///< whether it depends on the depth
    };

    void check_order() {
        for (const GradingRecipe& each : recipe_.gradings) {
            follow(each);
            if (!mistakes_.empty()) return;
        }
    }

    /// Follows a grading's dependencies; reports cycles and chains that are too long.
    Followed follow(const GradingRecipe& from) {
        if (const auto known = followed_.find(from.name); known != followed_.end()) return known->second;
        const auto again = std::find(path_.begin(), path_.end(), from.name);
        if (again != path_.end()) {
            std::string circle = "`" + from.name + "`";
            for (auto name = again + 1; name != path_.end(); ++name)
                circle += fmt::format(" uses `{}`, which", *name);
            refuse(from.where, fmt::format("{} uses `{}`", circle, from.name),
                   "gradings that do not depend on themselves");
            return {};
        }
        if (path_.size() >= deepest_grading) {
            refuse(from.where, fmt::format("gradings build on each other more than {} deep", deepest_grading),
                   "fewer levels");
            return {};
        }
        path_.push_back(from.name);
        Followed result;
        for (const std::string& name : needs(from)) {
            if (name == depth_name) result.depth = true;
            const GradingRecipe* below = grading(name);
            if (!below || !mistakes_.empty()) continue;
            const Followed deeper = follow(*below);
            result.levels = std::max(result.levels, deeper.levels);
            result.depth = result.depth || deeper.depth;
        }
        path_.pop_back();
        if (++result.levels > deepest_grading && mistakes_.empty()) {
            refuse(from.where, fmt::format("gradings build on each other more than {} deep", deepest_grading),
                   "fewer levels");
        }
        if (mistakes_.empty()) followed_[from.name] = result;
        return result;
    }

    /// Reports bodies that depend on gradings measured from the body's surface.
    void check_field_depths() {
        for (const FieldRecipe& field : recipe_.fields) {
            if (!field.formula.is_formula()) continue;
            for (const std::string& name : names_beyond_place(field.formula.formula())) {
                if (!followed_[name].depth) continue;
                refuse(
                    field.formula.where,
                    fmt::format("`{}` depends on the depth `d` below the surface, which this formula defines",
                                name),
                    "x, y, z and gradings without `d`");
            }
        }
    }

    const Recipe& recipe_;
    std::vector<std::string> mistakes_;
    std::map<std::string, Followed> followed_;
    std::vector<std::string> path_;
};

}  // namespace

std::vector<std::string> names_beyond_place(std::string_view formula) {
    std::vector<std::string> names = formula_names(formula);
    std::erase_if(names, [](const std::string& name) {
        return std::find(place_names.begin(), place_names.end(), name) != place_names.end();
    });
    return names;
}

bool uses_depth(const Recipe& recipe) {
    std::vector<const GradedNumber*> numbers = numbers_of(recipe);
    for (const GradingRecipe& grading : recipe.gradings)
        numbers.insert(numbers.end(), {&grading.formula, &grading.along});
    return std::ranges::any_of(numbers, [](const GradedNumber* number) {
        return number->is_formula() && uses_name(number->formula(), depth_name);
    });
}

std::string unused_entries(const Recipe& recipe) {
    std::set<std::string> used;
    std::vector<const GradedNumber*> open = numbers_of(recipe);
    std::string unused;
    const auto add = [&](const char* section, const std::string& name) {
        unused += fmt::format("{}[[{}]] `{}`", unused.empty() ? "" : ", ", section, name);
    };
    std::set<std::string> solids{recipe.part.field};
    for (const RegionRecipe& region : recipe.regions) solids.insert(region.field);
    for (const LoadRecipe& load : recipe.loads) solids.insert(load.field);
    for (const AnchorRecipe& anchor : recipe.anchors) solids.insert(anchor.field);
    for (const ElementRecipe& element : recipe.element_shapes) solids.insert(element.field);
    for (const FieldRecipe& field : recipe.fields) {
        if (solids.contains(field.name)) {
            open.push_back(&field.formula);
        } else {
            add("field", field.name);
        }
    }
    while (!open.empty()) {
        const GradedNumber* number = open.back();
        open.pop_back();
        if (!number->is_formula()) continue;
        for (const std::string& name : names_beyond_place(number->formula())) {
            if (!used.insert(name).second) continue;
            for (const GradingRecipe& grading : recipe.gradings) {
                if (grading.name == name) open.insert(open.end(), {&grading.formula, &grading.along});
            }
        }
    }
    for (const GradingRecipe& grading : recipe.gradings) {
        if (!used.contains(grading.name)) add("grading", grading.name);
    }
    return unused.empty() ? "" : "nothing uses " + unused;
}

std::vector<std::string> formula_mistakes(const Recipe& recipe) { return FormulaCheck(recipe).run(); }

std::vector<std::string> formula_text_mistakes(const Recipe& recipe) {
    return FormulaCheck(recipe).run_on_texts();
}

}  // namespace lamella
