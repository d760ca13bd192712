// Surveys with the machine's numbers, and what they found as part and supports.
#include "recipe/build/build_enclosure.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/solids/box_solid.h"
#include "engine/solids/csg.h"
#include "engine/surveys/hollow_survey.h"
#include "printers/registry.h"

namespace lamella {

namespace {

constexpr double finest_rows = 0.1;  // mm, where the recipe does not say

/// What both surveys know of the machine, in the coordinates of the job that is surveyed.
struct Steps {
    double bead = 0.45;
    double step = 0;
    double pitch = 0;
    int layers_at_once = 1;
};

/// `layer_height` is that of the print, mm; `across` is the factor by which the job will be scaled in its
/// layers' plane.
Steps steps_of(const Recipe& recipe, double layer_height, double overhang, double pitch, double across) {
    Steps steps;
    const double width = makes_beads(recipe.printer) ? recipe.printer.filament.line_width : steps.bead;
    if (overhang == 0) overhang = printable_overhang(recipe.printer, layer_height);
    steps.bead = width / across;
    steps.step = overhang / across;
    steps.pitch = (pitch > 0 ? pitch : std::max(overhang / 2, finest_rows)) / across;
    // A step must be two rows at least, so that roofs lean alike to all sides; one where rows are given.
    const double rows = pitch > 0 ? 1 : 2;
    steps.layers_at_once = std::max(1, static_cast<int>(std::ceil(rows * steps.pitch / steps.step - 1e-9)));
    return steps;
}

/// Runs a survey; what does not suit the part is the section's mistake.
template <typename Survey>
auto with_section(const char* section, Survey survey) {
    try {
        return survey();
    } catch (const InputError& error) {
        throw InputError(std::string(section) + ": " + error.what());
    }
}

}  // namespace

HollowReport hollow_out(const Recipe& recipe, Job& designed, double layer_height) {
    const CavityRecipe& cavity = *recipe.cavity;
    const dvec3 scale = recipe.process ? recipe.process->scale : dvec3(1);
    const double most = std::max(scale.x, scale.y), least = std::min({scale.x, scale.y, scale.z});
    const Steps steps = steps_of(recipe, layer_height, cavity.overhang, cavity.pitch, most);
    HollowOptions options;
    options.wall = cavity.wall / least;
    options.step = steps.step;
    options.bead = steps.bead;
    options.chamber = cavity.chamber / most;
    const double volume_scale = scale.x * scale.y * scale.z;
    options.min_volume = cavity.least / volume_scale;
    options.pitch = steps.pitch;
    options.layers_at_once = steps.layers_at_once;
    const HollowSurvey survey = with_section("[cavity]", [&] { return hollow_out(designed, options); });
    if (!survey.cavities->empty()) designed.part = make_without_boxes(designed.part, survey.cavities);
    return {survey.count, survey.volume * volume_scale, survey.left_solid, survey.part_volume * volume_scale};
}

nlohmann::ordered_json cavities_json(const HollowReport& cavities) {
    return {{"count", cavities.count},
            {"volume_mm3", cavities.volume},
            {"too_small", cavities.left_solid},
            {"part_mm3", cavities.part_volume}};
}

std::string shield_text(const ShieldSurvey& shield) {
    return fmt::format("a wall of {:.1f} mm3", shield.volume);
}

std::string cavities_text(const HollowReport& cavities) {
    std::string text = cavities.count == 0
                           ? std::string("the part has no room for one")
                           : fmt::format("{} of {:.1f} mm3, {:.1f} % of the part", cavities.count,
                                         cavities.volume, 100 * cavities.volume / cavities.part_volume);
    if (cavities.left_solid > 0) text += fmt::format("; {} too small, left solid", cavities.left_solid);
    return text;
}

std::optional<ShieldSurvey> add_shield(const Recipe& recipe, Job& job, const ShieldWork& work) {
    if (!recipe.shield) return std::nullopt;
    const ShieldRecipe& shield = *recipe.shield;
    const Steps steps = steps_of(recipe, job.layers.least_height(), shield.overhang, shield.pitch, 1);
    ShieldOptions options;
    options.gap = shield.gap;
    options.wall = shield.wall;
    options.step = steps.step;
    options.bead = steps.bead;
    options.pitch = steps.pitch;
    options.layers_at_once = steps.layers_at_once;
    options.threads = work.threads;
    options.cancel = work.cancel;
    ShieldSurvey survey = with_section("[shield]", [&] { return make_shield(job, options); });
    FieldPtr wall = make_box_solid(survey.wall);
    const Box box = unite(job.bounds, wall->bounds());
    job.supports = job.supports ? make_union({job.supports, wall}) : std::move(wall);
    job.bounds = {{box.lo.x, box.lo.y, job.bounds.lo.z}, {box.hi.x, box.hi.y, job.bounds.hi.z}};
    return survey;
}

}  // namespace lamella
