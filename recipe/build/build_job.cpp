// The order of things: body, depths below it, foam, skin, layers, process.
#include "recipe/build/build_job.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/error.h"
#include "engine/layers/survey_rows.h"
#include "engine/solids/box_solid.h"
#include "engine/solids/csg.h"
#include "engine/solids/shell.h"
#include "recipe/build/build_process.h"
#include "recipe/identity.h"

namespace lamella {

namespace {

constexpr int max_layers = 10'000'000;

/// A skin with windows before it is drilled, and the thickest that it is, mm.
struct CutSkin {
    FieldPtr shell;
    double depth = 0;
};

CutSkin cut_skin(const Recipe& recipe, BuiltJob& built, Gradings& gradings) {
    const GradedNumber& thickness = recipe.skin->thickness;
    CutSkin skin;
    if (thickness.is_formula() || !gradings.overrides("skin.thickness").empty()) {
        built.skin = graded("skin.thickness", thickness,
                            {recipe.skin->thickness_min, recipe.skin->thickness_max}, gradings);
        skin.shell = make_shell(built.body, built.skin->asked, built.skin->limits);
        skin.depth = built.skin->made->range(built.body->bounds()).hi;
    } else {
        skin.depth = thickness.number();
        skin.shell = make_shell(built.body, skin.depth);
    }
    skin.shell = cut_windows(recipe, std::move(skin.shell), built.body, skin.depth, gradings, built.pattern);
    return skin;
}

/// The body filled with foam, under a skin with holes.
FieldPtr drilled(const BuiltJob& built, FieldPtr shell, const std::vector<DrilledHole>& holes) {
    shell = without_holes(std::move(shell), holes);
    FieldPtr inside = built.foam ? make_union({built.foam->field, std::move(shell)}) : std::move(shell);
    std::vector<DrilledHole> through = holes;
    std::erase_if(through, [](const DrilledHole& hole) { return !hole.through; });
    return without_holes(make_intersection({built.body, std::move(inside)}), through);
}

/// The part under a skin with windows and holes; drains are placed once all else is there.
FieldPtr with_cut_skin(const Recipe& recipe, BuiltJob& built, Gradings& gradings) {
    const CutSkin skin = cut_skin(recipe, built, gradings);
    built.holes = drilled_holes(recipe, *built.body, skin.depth);
    FieldPtr part = drilled(built, skin.shell, built.holes);
    if (recipe.skin->drains == 0) return part;
    Job job = built.designed;
    job.part = part;
    built.drains = place_drains(recipe, job, *built.body, skin.depth);
    std::vector<DrilledHole> holes = built.holes;
    holes.insert(holes.end(), built.drains->holes.begin(), built.drains->holes.end());
    return drilled(built, skin.shell, holes);
}

/// The body itself, or filled with foam and skin.
FieldPtr part_of(const Recipe& recipe, BuiltJob& built, Gradings& gradings) {
    const FieldPtr foam = built.foam ? built.foam->field : nullptr;
    if (!foam && !recipe.skin) return built.body;
    if (!recipe.skin) return make_filled_body(built.body, foam, 0);
    const GradedNumber& thickness = recipe.skin->thickness;
    try {
        if (has_cut_skin(recipe)) return with_cut_skin(recipe, built, gradings);
        const SkinSide side = recipe.skin->side;
        const bool varies = thickness.is_formula() || !gradings.overrides("skin.thickness").empty();
        if (!varies) return make_filled_body(built.body, foam, thickness.number(), side);
        built.skin = graded("skin.thickness", thickness,
                            {recipe.skin->thickness_min, recipe.skin->thickness_max}, gradings);
        return make_filled_body(built.body, foam, built.skin->asked, built.skin->limits, side);
    } catch (const LocatedError&) {
        throw;
    } catch (const InputError& error) {
        throw InputError((thickness.where.empty() ? "skin.thickness" : thickness.where) + ": " +
                         error.what() + "; accepted: a mesh, or another shape than this one");
    }
}

int layers_of(double height, double layer_height) {
    if (height / layer_height > max_layers) {
        throw InputError(
            fmt::format("layers.height / --layer-height: {} mm cuts a part of {} mm into more than {} "
                        "layers; accepted: {} mm or more",
                        layer_height, height, max_layers, height / max_layers));
    }
    return count_layers(height, layer_height);
}

/// Cuts the designed part's bounds into layers.
void set_layers(const Recipe& recipe, Job& job) {
    job.layer_height = designed_layer_height(recipe);
    job.layer_count =
        layers_of(job.bounds.size().z * (recipe.layer_height / job.layer_height), recipe.layer_height);
}

/// The least that a graded number of the foam becomes in the part's box.
double min_of(const GradedUse& use, const Box& bounds) { return tight_range(*use.made, bounds).lo; }

double survey_pitch(const BuiltJob& built, Interval suited) {
    constexpr double without_foam = 0.1;
    double pitch = without_foam;
    if (built.foam) {
        const bool beams = built.foam->member.key == "foam.beam";
        pitch = min_of(built.foam->member, built.designed.bounds) / (beams ? 3 : 6);
        for (const GradedUse& other : built.foam->others) {
            if (other.key == "foam.wall") pitch = std::min(pitch, min_of(other, built.designed.bounds) / 6);
        }
    }
    return std::min(std::max(pitch, suited.lo), suited.hi);
}

}  // namespace

BuiltJob build_job(const Recipe& recipe) {
    BuiltJob built;
    Gradings gradings(recipe);
    built.body = build_body(recipe, gradings, built.mesh);
    Job& job = built.designed;
    job.bounds = built.body->bounds();
    const std::string where = recipe.part.mesh.empty() ? "part" : recipe.part.mesh;
    if (job.bounds.empty()) throw InputError(where + ": the part is empty; a solid with a volume is needed");
    gradings.set_body(built.body);
    built.regions = build_regions(recipe, job.bounds, gradings);
    if (recipe.foam) built.foam = build_foam(*recipe.foam, job.bounds, gradings);
    set_layers(recipe, job);
    job.part =
        with_regions(part_of(recipe, built, gradings), built.body, recipe.foam || recipe.skin, built.regions);
    built.outside = built.body;
    if (recipe.skin && recipe.skin->side != SkinSide::inside) {
        built.outside = make_union({built.body, job.part});
        job.bounds = built.outside->bounds();
        set_layers(recipe, job);
    }
    if (recipe.cavity) {
        built.before_cavities = job.part;
        built.cavities = hollow_out(recipe, job);
    }
    if (asks_for_dowels(recipe)) {
        built.dowels = place_dowels(recipe, job);
        job.part = without_dowels(job.part, *built.dowels);
    }
    job.name = recipe.part.name;
    job.identity = job_identity(recipe);
    if (built.foam && built.foam->modulus) {
        built.modulus = modulus_report(*built.foam->modulus, *built.body);
        job.notes = modulus_lines(*built.modulus);
    }
    built.job = make_processed(recipe, job);
    return built;
}

void drop_islands(const Recipe& recipe, BuiltJob& built, IslandSurveyOptions options) {
    const bool given = recipe.foam && recipe.foam->islands_pitch > 0;
    const Interval suited = survey_pitch_range(built.designed);
    options.pitch = given ? recipe.foam->islands_pitch : survey_pitch(built, suited);
    if (!suited.contains(options.pitch)) {
        throw InputError(
            fmt::format("foam.islands_pitch / --islands-pitch: {} mm does not suit the part; "
                        "accepted: {:.4g} to {:.4g} mm, the latter being 16 layers",
                        options.pitch, suited.lo, suited.hi));
    }
    IslandSurvey survey = survey_islands(built.designed, built.outside, options);
    built.islands = std::move(survey.report);
    if (survey.dropped->empty()) return;
    built.designed.part = make_without_boxes(built.designed.part, survey.dropped);
    built.job = make_processed(recipe, built.designed);
}

BuiltFoam build_foam_alone(const Recipe& recipe, const Box& region, std::int64_t repeats_after) {
    if (recipe.frame) {
        throw InputError(
            recipe.frame->beam.where +
            ": a frame follows the part's surface, and there is no part; accepted: [part] with it");
    }
    Gradings gradings(recipe);
    build_regions(recipe, region, gradings);
    return build_foam(*recipe.foam, region, gradings, repeats_after);
}

}  // namespace lamella
