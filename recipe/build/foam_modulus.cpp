// Looks up laws by the foam's name; solves for sizes from moduli.
#include "recipe/build/foam_modulus.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/error.h"
#include "engine/base/whole_file.h"
#include "procedural/grading/text_rows.h"
#include "recipe/build/build_foam.h"
#include "recipe/identity.h"
#include "recipe/recipe_formulas.h"
#include "recipe/settings.h"
#include "recipe/shipped_texts.h"

namespace lamella {

namespace {

/// Reads tests from a file: cell (mm), member (mm) and modulus (MPa) on each line, after an optional line of
/// column names.
std::vector<StiffnessTest> read_tests(const std::string& path) {
    const std::string text = whole_file(path, "a table of compression tests");
    std::vector<StiffnessTest> tests;
    bool headed = false;
    for (const TextRow& row : text_rows(text)) {
        const std::string where = fmt::format("{}:{}: ", path, row.number);
        if (tests.empty() && !headed && row.cells.front().find_first_of("0123456789") != 0) {
            headed = true;
            continue;
        }
        const std::vector<double> numbers = numbers_of(row.cells, where);
        constexpr double least = 1e-9, most = 1e9;
        if (numbers.size() != 3 || !(std::ranges::min(numbers) >= least && std::ranges::max(numbers) <= most))
            throw InputError(where +
                             "not three positive numbers (1e-9 to 1e9); accepted: cell (mm), member (mm) and "
                             "modulus (MPa) on each line");
        tests.push_back({numbers[1] / numbers[0], numbers[2]});
    }
    if (tests.empty())
        throw InputError(path +
                         ": contains no test; accepted: lines of cell (mm), member (mm), modulus (MPa)");
    return tests;
}

}  // namespace

std::optional<FoamLawTable> known_law(const FoamRecipe& foam) {
    std::vector<FoamLawTable> laws = foam.law.empty()
                                         ? read_foam_laws(shipped_foam_laws(), "foam_laws.csv")
                                         : read_foam_laws(whole_file(foam.law, "a foam's law"), foam.law);
    const auto known = std::ranges::find(laws, law_name(foam), &FoamLawTable::foam);
    return known == laws.end() ? std::nullopt : std::optional(std::move(*known));
}

std::string law_name(const FoamRecipe& foam) {
    const FoamBuilder& kind = builder_of(foam);
    std::string name = foam.kind;
    if (kind.takes("jitter")) name += fmt::format("/jitter={}", foam.jitter);
    if (kind.takes("neighbours")) name += fmt::format("/neighbours={}", foam.neighbours);
    if (kind.takes("window")) {
        name += fmt::format("/wall={:.4g}beam/window={}", foam.wall.number() / foam.beam.number(),
                            foam.window.number());
    }
    if (kind.takes("network") && foam.network) name += "/network";
    if (!foam.unit_cell.empty()) name += "/" + foam.unit_cell;
    if (!foam.struts.empty()) {
        Fnv128 hash;
        hash.add(format_value(foam.struts));
        name += "/struts=" + hash.hex().substr(0, 12);
    }
    return name;
}

FoamModulusPtr foam_modulus(const Recipe& recipe, const BaseMaterial& material) {
    const std::optional<FoamLawTable> known = known_law(*recipe.foam);
    if (!known) return nullptr;
    FoamLaw law(*known, material.elastic.poisson);
    const std::string& path = recipe.material->tests;
    if (path.empty()) return std::make_shared<FoamModulus>(std::move(law), material.elastic.young);
    const std::vector<StiffnessTest> tests = read_tests(path);
    try {
        return std::make_shared<FoamModulus>(std::move(law), material.elastic.young, tests);
    } catch (const InputError& error) {
        throw InputError(path + ": " + error.what());
    }
}

namespace {

GradedUse member_use(const FoamRecipe& foam, Gradings& gradings,
                     const std::map<std::string, GradingPtr>& names) {
    return member_of(foam) == "wall"
               ? graded("foam.wall", foam.wall, {foam.wall_min, foam.wall_max}, gradings, names)
               : graded("foam.beam", foam.beam, {foam.beam_min, foam.beam_max}, gradings, names);
}

/// Returns the number that follows from a modulus in place of a recipe's.
GradedUse solved(const std::string& key, GradingPtr asked, Interval limits) {
    // Ranges are widened for rounding; a uniform foam must remain recognisable as constant.
    if (const auto same = asked->constant()) asked = make_constant_grading(*same);
    GradingPtr made = make_clamped_grading(asked, limits);
    return {key, std::move(asked), std::move(made), limits, "mm"};
}

/// Returns true if beams, walls and windows of closed cells keep one proportion, as their law requires.
bool is_proportioned(const FoamRecipe& foam, const Gradings& gradings) {
    if (!builder_of(foam).traits.is_closed) return true;
    const bool same = !foam.beam.is_formula() && !foam.wall.is_formula() && !foam.window.is_formula();
    const auto overridden = [&](const char* key) { return !gradings.overrides(key).empty(); };
    return same && !overridden("foam.beam") && !overridden("foam.wall") && !overridden("foam.window");
}

/// Returns true if one law can describe the whole foam.
bool has_one_shape(const FoamRecipe& foam, const Gradings& gradings) {
    return constant(foam.stretch) == dvec3(1) && is_proportioned(foam, gradings);
}

void check_shape(const FoamRecipe& foam, const Gradings& gradings) {
    if (is_proportioned(foam, gradings)) return;
    throw InputError(foam.modulus.where +
                     ": the law of closed cells requires uniform beams, walls and windows; accepted: numbers "
                     "instead of formulas for them, and no region that changes one");
}

FoamSizes sizes_for_modulus(const FoamRecipe& foam, Gradings& gradings, const BuiltModulus& modulus) {
    const GradingPtr& wanted = modulus.asked->made;
    const bool has_cell = foam.cell.is_formula() || foam.cell.number() > 0;
    FoamSizes sizes;
    if (has_cell) {
        sizes.cell = graded("foam.cell", foam.cell, {foam.cell_min, foam.cell_max}, gradings);
        const bool wall = member_of(foam) == "wall";
        sizes.member = solved(
            wall ? "foam.wall" : "foam.beam", make_member_for_modulus(wanted, sizes.cell.made, modulus.foam),
            wall ? Interval{foam.wall_min, foam.wall_max} : Interval{foam.beam_min, foam.beam_max});
    } else {
        sizes.member = member_use(foam, gradings, {});
        sizes.cell = solved("foam.cell", make_cell_for_modulus(wanted, sizes.member.made, modulus.foam),
                            {foam.cell_min, foam.cell_max});
    }
    return sizes;
}

}  // namespace

FoamSizes foam_sizes(const FoamRecipe& foam, Gradings& gradings, std::optional<BuiltModulus>& modulus) {
    const Recipe& recipe = gradings.recipe();
    const bool asks = foam.modulus.is_formula() || foam.modulus.number() > 0;
    const bool has_material = recipe.material && has_modulus(*recipe.material);
    if (asks) check_shape(foam, gradings);
    if (has_material && has_one_shape(foam, gradings)) {
        const BaseMaterial material = base_material(*recipe.material);
        if (auto known = foam_modulus(recipe, material))
            modulus = BuiltModulus{{}, nullptr, std::move(known), material};
    }
    if (!modulus && (asks || (recipe.material && !recipe.material->tests.empty()))) {
        throw InputError(
            fmt::format("{}: there is no stiffness law for this foam ({}); accepted: foam.law / --foam-law "
                        "with a file that `lamella homogenize --table` writes for it",
                        asks ? foam.modulus.where : "material.tests / --material-tests", law_name(foam)));
    }
    FoamSizes sizes;
    if (asks) {
        modulus->asked = graded("foam.modulus", foam.modulus, {0, infinity}, gradings);
        sizes = sizes_for_modulus(foam, gradings, *modulus);
    } else {
        sizes.cell = graded("foam.cell", foam.cell, {foam.cell_min, foam.cell_max}, gradings);
        sizes.member = member_use(foam, gradings, {{std::string(cell_name), sizes.cell.made}});
    }
    if (modulus) modulus->made = make_modulus_of(sizes.cell.made, sizes.member.made, modulus->foam);
    return sizes;
}

}  // namespace lamella
