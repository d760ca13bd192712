// Rules about loads, anchors and what is optimised.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

#include "engine/base/error.h"
#include "recipe/base_material.h"
#include "recipe/build/build_foam.h"
#include "recipe/keys/settings_rows.h"
#include "recipe/recipe_draft.h"
#include "recipe/recipe_formulas.h"
#include "recipe/recipe_regions.h"
#include "recipe/result_dependents.h"

namespace lamella {

namespace {

constexpr std::string_view axis_letters = "xyz";

/// Returns true if a text has one or more of the letters x, y and z, each at most once.
bool names_axes(std::string_view text) {
    std::set<char> seen;
    return !text.empty() && std::ranges::all_of(text, [&](char c) {
        return axis_letters.find(c) != std::string_view::npos && seen.insert(c).second;
    });
}

bool has_key(const Kind& kind, const std::string& key) {
    return std::ranges::find(kind.needs, key) != kind.needs.end() ||
           std::ranges::find(kind.takes, key) != kind.takes.end();
}

/// Returns the first of these names that a formula uses; empty when it uses none.
std::string used_name(const GradedNumber& number, const std::set<std::string>& names) {
    if (!number.is_formula()) return "";
    for (const std::string& name : names_beyond_place(number.formula())) {
        if (names.contains(name)) return name;
    }
    return "";
}

/// Returns a message for each foam region that a search for the foam's numbers cannot take into account.
/// Formulas must be free of syntax errors.
std::vector<std::string> driven_region_mistakes(const Recipe& recipe) {
    std::vector<std::string> mistakes;
    const ResultDependents late(recipe);
    const bool is_closed = builder_of(*recipe.foam).traits.is_closed;
    const bool drives_cells = recipe.optimize->result == OptimizeResult::cell;
    for (const RegionRecipe& region : recipe.regions) {
        if (region.make != RegionMake::foam) continue;
        const auto depends = [&](const std::string& where, const std::string& name) {
            mistakes.push_back(fmt::format(
                "{}: `{}` depends on the result of the search, which has to know the foam of this "
                "region; accepted: what does not, or optimize.result = \"field\"",
                where, name));
        };
        if (late.fields.contains(region.field)) depends(region.where + ".field", region.field);
        for (const RegionNumber& given : numbers_of(region)) {
            const std::string& where = given.number->where;
            if (const std::string name = used_name(*given.number, late.gradings); !name.empty())
                depends(where, name);
            if (drives_cells && !used_name(*given.number, {std::string(cell_name)}).empty())
                mistakes.push_back(
                    fmt::format("{}: `{}` is what the search drives; accepted: a formula without it, or a "
                                "number",
                                where, cell_name));
            const bool shapes = is_closed && given.key != "foam.cell";
            if (shapes && (given.number->is_formula() || region.blend > 0))
                mistakes.push_back(
                    fmt::format("{}: the law of closed cells is that of one proportion of beams, walls and "
                                "windows; accepted: a number, in a region without blend",
                                where));
        }
    }
    return mistakes;
}

}  // namespace

/// Checks which keys of loads, anchors and [optimize] are given together.
void RecipeDraft::check_problem_keys() {
    for (const char* section : {"load", "anchor"}) {
        for (std::size_t i = 0; i < count(*find_section(section)); ++i) check_place_keys(section, i);
    }
    for (std::size_t i = 0; i < count(*find_section("anchor")); ++i) check_axes("anchor", "fix", i);
    check_axes("optimize", "symmetry", 0);
    check_at_most_one({"optimize", 0}, {"volume", "mass"});
    check_at_most_one({"optimize", 0}, {"element", "elements"});
    check_at_most_one({"optimize", 0}, {"radius", entry("optimize", "member") ? "member" : "gap"});
}

/// Checks that a place is given in one way.
void RecipeDraft::check_place_keys(const std::string& section, std::size_t number) {
    const Part part{section, number};
    const bool at = entry(section, "at", number) != nullptr;
    const bool normal = entry(section, "normal", number) != nullptr;
    if (at || normal) {
        for (const char* key : {"at", "normal"}) check_need(part, key, "a plane");
    }
    check_need(part, at && !normal ? "field|box|at|face" : "field|box|normal|face", "[[" + section + "]]");
}

void RecipeDraft::check_axes(const std::string& section, const std::string& key, std::size_t number) {
    const Entry* given = entry(section, key, number);
    if (!given || !given->value) return;
    const auto& text = std::get<std::string>(*given->value);
    if (names_axes(text)) return;
    refuse(
        0,
        fmt::format(
            "{}: the letters \"{}\" do not name axes; accepted: one or more of the letters x, y and z, each "
            "at most once",
            given->where, text.substr(0, 64)));
}

/// Checks loads and anchors, and what is optimised under them.
void RecipeDraft::check_problem(const Recipe& recipe) {
    for (std::size_t i = 0; i < recipe.loads.size(); ++i) {
        check_place(recipe, "load", i, recipe.loads[i]);
        if (recipe.loads[i].force != dvec3(0) || recipe.loads[i].pressure > 0) continue;
        refuse(0, fmt::format("{}: is no force; accepted: one that is not 0 along every axis",
                              where("load", "force", i)));
    }
    for (std::size_t i = 0; i < recipe.anchors.size(); ++i)
        check_place(recipe, "anchor", i, recipe.anchors[i]);
    check_weights(recipe);
    if (mistakes_.empty()) check_result_entries(recipe);
    if (recipe.optimize) check_optimize(recipe);
}

/// Checks that entries of kind `optimized` are used after the search, and that there is one.
void RecipeDraft::check_result_entries(const Recipe& recipe) {
    const ResultDependents late(recipe);
    if (!recipe.optimize) {
        const auto refuse_kind = [&](const auto& entries) {
            for (const auto& entry : entries) {
                if (entry.kind != optimized_kind) continue;
                refuse(0,
                       fmt::format("{}.kind: \"{}\" is the result of a search, and there is none; accepted: "
                                   "a section [optimize] as well, or another kind",
                                   entry.where, optimized_kind));
            }
        };
        refuse_kind(recipe.fields);
        refuse_kind(recipe.gradings);
        return;
    }
    const auto refuse_early = [&](const std::string& place, const std::string& field) {
        if (!late.fields.contains(field)) return;
        refuse(0, fmt::format("{}: `{}` depends on the result of the search, which begins with this field; "
                              "accepted: a field that does not",
                              place, field));
    };
    refuse_early(where("part", "field"), recipe.part.field);
    for (std::size_t i = 0; i < recipe.loads.size(); ++i)
        refuse_early(where("load", "field", i), recipe.loads[i].field);
    for (std::size_t i = 0; i < recipe.anchors.size(); ++i)
        refuse_early(where("anchor", "field", i), recipe.anchors[i].field);
    if (recipe.optimize->result == OptimizeResult::field && late.fields.empty() && late.gradings.empty()) {
        refuse(0, fmt::format("{}: \"field\" leaves the part as it is, and nothing uses what is found; "
                              "accepted: a [[field]] or [[grading]] of kind \"{}\" as well, or solid",
                              where("optimize", "result"), optimized_kind));
    }
}

void RecipeDraft::check_place(const Recipe& recipe, const std::string& section, std::size_t number,
                              const PlaceRecipe& place) {
    if (!place.field.empty()) {
        std::string wrong = unknown_field(recipe, where(section, "field", number), place.field);
        if (!wrong.empty()) refuse(0, std::move(wrong));
    }
    if (!place.box.empty() && box_of(place.box).empty()) {
        refuse(0, fmt::format("{}: a coordinate of the first corner is above that of the second; accepted: "
                              "the lower corner first",
                              where(section, "box", number)));
    }
    if (entry(section, "normal", number) && place.normal == dvec3(0)) {
        refuse(0, fmt::format("{}: has no direction; accepted: one that is not 0 along every axis",
                              where(section, "normal", number)));
    }
}

/// Checks that loads of one case have one weight.
void RecipeDraft::check_weights(const Recipe& recipe) {
    std::map<std::string, std::size_t> first_of_case;
    for (std::size_t i = 0; i < recipe.loads.size(); ++i) {
        const LoadRecipe& load = recipe.loads[i];
        const std::size_t first = first_of_case.emplace(load.load_case, i).first->second;
        if (load.weight == recipe.loads[first].weight) continue;
        refuse(0, fmt::format("{}: {} differs from {} ({}), of a load of the same case \"{}\"; accepted: one "
                              "weight for all loads of a case",
                              where("load", "weight", i), load.weight, recipe.loads[first].weight,
                              where("load", "weight", first), load.load_case.substr(0, 64)));
    }
}

/// Checks what is optimised.
void RecipeDraft::check_optimize(const Recipe& recipe) {
    const OptimizeRecipe& optimize = *recipe.optimize;
    if (recipe.loads.empty() && optimize.gravity == dvec3(0)) {
        refuse(0, fmt::format("{}: nothing loads the body; accepted: a [[load]] or optimize.gravity / "
                              "--optimize-gravity as well",
                              where_begins("optimize", 0)));
    }
    check_held(recipe);
    check_density(recipe);
    if (optimize.dimensions == 2) check_two_dimensions(recipe);
    if (drives_foam(optimize.result)) check_driven_foam(recipe);
    if (optimize.kind == OptimizeKind::appearance) check_appearance(recipe);
    if (optimize.kind == OptimizeKind::lightness && optimize.gravity != dvec3(0)) {
        refuse(0, fmt::format("{}: with optimize.kind = \"lightness\", less volume must not mean less load; "
                              "accepted: no gravity, or kind stiffness",
                              where("optimize", "gravity")));
    }
    // The smallest volume stands beside a mass whose share of the part is not known here.
    if (optimize.mass == 0 && optimize.volume_min > optimize.volume) {
        refuse(0, fmt::format("{}: {} is more than {}, {}; accepted: at most the largest volume",
                              where("optimize", "volume_min"), optimize.volume_min,
                              where("optimize", "volume"), optimize.volume));
    }
    if (optimize.sharpness == 0 && (optimize.member > 0 || optimize.gap > 0)) {
        refuse(
            0,
            fmt::format(
                "{}: 0 is no projection, without which {} has no effect; accepted: above 0, or no least size",
                where("optimize", "sharpness"), where("optimize", optimize.member > 0 ? "member" : "gap")));
    }
}

/// Checks that the search for an appearance is asked for what it can do.
void RecipeDraft::check_appearance(const Recipe& recipe) {
    const OptimizeRecipe& optimize = *recipe.optimize;
    const auto refuse_key = [&](const char* key, const char* wrong, const char* right) {
        refuse(0, fmt::format("{}: {} with optimize.kind = \"appearance\"; accepted: {}, or kind stiffness",
                              where("optimize", key), wrong, right));
    };
    if (optimize.method == OptimizeMethod::oc)
        refuse_key("method", "\"oc\" cannot bound the compliance", "mma");
    if (optimize.dimensions != 2) refuse_key("dimensions", "a picture is one of a plate, which has two", "2");
    if (drives_foam(optimize.result)) refuse_key("result", "a foam looks like itself", "solid or field");
    if (optimize.member > 0) refuse_key("member", "there is no least size", "lines as wide in the picture");
    if (optimize.gap > 0) refuse_key("gap", "there is no least size", "gaps as wide in the picture");
    if (optimize.tolerance != OptimizeRecipe().tolerance)
        refuse_key("tolerance", "all steps are taken", "iterations");
}

/// Checks that anchors hold the body along every axis.
void RecipeDraft::check_held(const Recipe& recipe) {
    const std::string begin = where_begins("optimize", 0);
    if (recipe.anchors.empty()) {
        return refuse(
            0, fmt::format("{}: nothing holds the body; accepted: one or more [[anchor]] as well", begin));
    }
    std::vector<char> loose;
    for (const char axis : axis_letters.substr(0, static_cast<std::size_t>(recipe.optimize->dimensions))) {
        const auto fixes = [&](const AnchorRecipe& a) { return a.fix.find(axis) != std::string::npos; };
        if (std::ranges::none_of(recipe.anchors, fixes)) loose.push_back(axis);
    }
    if (loose.empty()) return;
    refuse(0, fmt::format("{0}: the body is not held along {1}; accepted: an [[anchor]] whose fix has {1}",
                          begin, fmt::join(loose, " and ")));
}

/// Checks that a plate is asked for nothing across it.
void RecipeDraft::check_two_dimensions(const Recipe& recipe) {
    const OptimizeRecipe& optimize = *recipe.optimize;
    const auto refuse_across = [&](const std::string& place, const char* what, const char* right) {
        refuse(0, fmt::format("{}: {} with optimize.dimensions = 2; accepted: {}, or three dimensions", place,
                              what, right));
    };
    if (optimize.overhang) refuse_across(where("optimize", "overhang"), "layers are all the same", "false");
    if (optimize.symmetry.find('z') != std::string::npos)
        refuse_across(where("optimize", "symmetry"), "there is no middle along z", "x and y");
    if (optimize.gravity.z != 0)
        refuse_across(where("optimize", "gravity"), "a plate bears no load along z", "0 along z");
    for (std::size_t i = 0; i < recipe.loads.size(); ++i) {
        const LoadRecipe& load = recipe.loads[i];
        if (load.force.z != 0)
            refuse_across(where("load", "force", i), "a plate bears no load along z", "0 along z");
        if (load.pressure > 0 && load.face.ends_with('z'))
            refuse_across(where("load", "face", i), "a plate bears no load along z", "-x, +x, -y, +y");
    }
}

/// Checks that the material's density is known where it is needed.
void RecipeDraft::check_density(const Recipe& recipe) {
    std::vector<const char*> needing;
    if (recipe.optimize->mass > 0) needing.push_back("mass");
    if (recipe.optimize->gravity != dvec3(0)) needing.push_back("gravity");
    if (needing.empty()) return;
    try {
        if (recipe.material && base_material(*recipe.material).density > 0) return;
    } catch (const InputError& error) {
        return refuse(0, error.what());
    }
    for (const char* key : needing) {
        refuse(0, fmt::format("{}: needs the material's density; accepted: material.name / --material or "
                              "material.density / --density as well",
                              where("optimize", key)));
    }
}

/// Checks that the foam has the number that is driven, and a law that says what it is worth.
void RecipeDraft::check_driven_foam(const Recipe& recipe) {
    const std::string key =
        choice_names(recipe.optimize->result)[static_cast<std::size_t>(recipe.optimize->result)];
    const auto refuse_result = [&](const std::string& wrong, const std::string& right) {
        refuse(0, fmt::format("{}: {}; accepted: {}, or solid", where("optimize", "result"), wrong, right));
    };
    if (!recipe.foam) {
        return refuse_result(fmt::format("\"{}\" varies the part's foam, and there is none", key),
                             "a section [foam] as well");
    }
    const FoamRecipe& foam = *recipe.foam;
    const FoamBuilder& builder = builder_of(foam);
    if (!has_key(builder.kind, key)) {
        std::vector<std::string> kinds;
        for (const FoamBuilder& other : foam_builders()) {
            if (has_key(other.kind, key) && !other.traits.is_closed) kinds.push_back(other.kind.word);
        }
        return refuse_result(fmt::format("\"{}\" does not apply to foam.kind {}", key, foam.kind),
                             fmt::format("foam.kind = one of {}", fmt::join(kinds, ", ")));
    }
    if (entry("foam", "modulus")) {
        refuse_result(fmt::format("\"{}\" conflicts with {}, which determines the foam's numbers, too", key,
                                  where("foam", "modulus")),
                      "no foam.modulus");
    }
    const GradedNumber& driven = key == "cell"               ? foam.cell
                                 : member_of(foam) == "wall" ? foam.wall
                                                             : foam.beam;
    if (driven.is_formula())
        refuse_result(fmt::format("\"{}\" replaces {}, which is a formula", key, driven.where),
                      "a number there");
    if (constant(foam.stretch) != dvec3(1)) {
        refuse(0, fmt::format("{}: there is no stiffness law for stretched cells; accepted: optimize.result "
                              "= \"{}\" without a stretch",
                              where("foam", "stretch"), key));
    }
    if (builder.traits.is_closed &&
        (key != "cell" || foam.beam.is_formula() || foam.wall.is_formula() || foam.window.is_formula())) {
        return refuse_result("the law of closed cells requires uniform beams, walls and windows",
                             "cell with numbers for them");
    }
    if (mistakes_.empty()) {
        for (std::string& wrong : driven_region_mistakes(recipe)) refuse(0, std::move(wrong));
    }
    try {
        if (known_law(foam)) return;
        refuse_result(fmt::format("there is no stiffness law for this foam ({})", law_name(foam)),
                      "foam.law / --foam-law with a file that `lamella homogenize --table` writes for it");
    } catch (const InputError& error) {
        refuse(0, error.what());
    }
}

}  // namespace lamella
