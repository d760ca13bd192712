// Rules that relate a region's keys to the fields, the foam and the skin.
#include "recipe/recipe_regions.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "recipe/recipe_kinds.h"
#include "recipe/settings.h"

namespace lamella {

namespace {

bool is_given(const GradedNumber& number, bool zero_counts) {
    return number.is_formula() || number.number() > 0 || (zero_counts && number.number() == 0);
}

/// Returns the limits of a number in the foam or skin; nothing when it has no such number.
std::optional<Interval> limits_of(const Recipe& recipe, const std::string& key) {
    if (key == "skin.thickness") return Interval{recipe.skin->thickness_min, recipe.skin->thickness_max};
    const FoamRecipe& foam = *recipe.foam;
    // Of a foam's modulus, cells and members, the one that is not given follows from the other two.
    if (key == "foam.modulus" && !is_given(foam.modulus, false)) return std::nullopt;
    if (key == "foam.modulus") return Interval{0, infinity};
    if (key == "foam.cell" && !is_given(foam.cell, false)) return std::nullopt;
    for (const KindSection& section : kind_sections()) {
        if (section.section != "foam") continue;
        const auto kind = std::find_if(section.kinds.begin(), section.kinds.end(),
                                       [&](const Kind& k) { return k.word == foam.kind; });
        const std::string word = key.substr(key.find('.') + 1);
        const auto has = [&](const std::vector<std::string>& keys) {
            return std::find(keys.begin(), keys.end(), word) != keys.end();
        };
        if (!has(kind->needs) && !has(kind->takes)) return std::nullopt;
    }
    if (key == "foam.cell") return Interval{foam.cell_min, foam.cell_max};
    if (key == "foam.beam" && !is_given(foam.beam, false)) return std::nullopt;
    if (key == "foam.wall" && !is_given(foam.wall, false)) return std::nullopt;
    if (key == "foam.beam") return Interval{foam.beam_min, foam.beam_max};
    if (key == "foam.wall") return Interval{foam.wall_min, foam.wall_max};
    return Interval{0, 1};
}

void check_number(const Recipe& recipe, const RegionNumber& given, std::vector<std::string>& mistakes) {
    const auto limits = limits_of(recipe, given.key);
    const std::string& where = given.number->where;
    if (!limits) {
        mistakes.push_back(
            fmt::format("{}: does not apply to foam.kind {}; accepted: a key that [foam] of this kind has",
                        where, recipe.foam->kind));
    } else if (!given.number->is_formula() && !limits->contains(given.number->number())) {
        mistakes.push_back(fmt::format("{}: {} lies outside {}_min and {}_max; accepted: {} to {}", where,
                                       given.number->number(), given.key, given.key, limits->lo, limits->hi));
    }
}

void check_region(const Recipe& recipe, const RegionRecipe& region, std::vector<std::string>& mistakes) {
    if (std::string wrong = unknown_field(recipe, region.where + ".field", region.field); !wrong.empty())
        mistakes.push_back(std::move(wrong));
    const std::vector<RegionNumber> numbers = numbers_of(region);
    const bool rules_supports = region.make == RegionMake::blocker || region.make == RegionMake::enforcer;
    if (rules_supports && recipe.support == SupportKind::none) {
        mistakes.push_back(
            fmt::format("{}.make: blockers and enforcers need supports, and there are none; accepted: a "
                        "section [support] as well",
                        region.where));
    }
    if (region.make == RegionMake::foam) {
        if (!recipe.foam) {
            mistakes.push_back(
                fmt::format("{}.make: \"foam\" changes the part's foam, and there is none; accepted: a "
                            "section [foam] as well, or solid, empty, skin",
                            region.where));
            return;
        }
        if (numbers.empty() && region.tool.empty() && region.layer_height == 0) {
            mistakes.push_back(
                fmt::format("{}: sets no number of the foam; accepted: one or more of cell, beam, wall, "
                            "window, modulus, tool and layer_height",
                            region.where));
        }
    }
    for (const RegionNumber& given : numbers) check_number(recipe, given, mistakes);
}

}  // namespace

std::string unknown_field(const Recipe& recipe, const std::string& where, const std::string& name) {
    std::vector<std::string> known;
    for (const FieldRecipe& field : recipe.fields) known.push_back(field.name);
    if (std::find(known.begin(), known.end(), name) != known.end()) return "";
    const std::string near = nearest(name, known);
    return fmt::format("{}: no [[field]] is named \"{}\"{}; accepted: {}", where, name.substr(0, 64),
                       near.empty() ? "" : fmt::format(", did you mean `{}`?", near),
                       known.empty() ? "the name of a [[field]]" : fmt::format("{}", fmt::join(known, ", ")));
}

std::vector<RegionNumber> numbers_of(const RegionRecipe& region) {
    std::vector<RegionNumber> numbers;
    if (region.make == RegionMake::skin) numbers.push_back({"skin.thickness", &region.thickness});
    if (region.make != RegionMake::foam) return numbers;
    if (is_given(region.cell, false)) numbers.push_back({"foam.cell", &region.cell});
    if (is_given(region.beam, false)) numbers.push_back({"foam.beam", &region.beam});
    if (is_given(region.wall, false)) numbers.push_back({"foam.wall", &region.wall});
    if (is_given(region.window, true)) numbers.push_back({"foam.window", &region.window});
    if (is_given(region.modulus, false)) numbers.push_back({"foam.modulus", &region.modulus});
    return numbers;
}

std::vector<std::string> region_mistakes(const Recipe& recipe) {
    std::vector<std::string> mistakes;
    for (const RegionRecipe& region : recipe.regions) check_region(recipe, region, mistakes);
    return mistakes;
}

}  // namespace lamella
