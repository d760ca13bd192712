// The order of things: body, depths below it, foam, skin, layers, process.
#include "recipe/build/build_job.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/error.h"
#include "engine/layers/survey_rows.h"
#include "engine/solids/box_solid.h"
#include "engine/solids/csg.h"
#include "recipe/build/build_process.h"
#include "recipe/build/fill_body.h"
#include "recipe/identity.h"
#include "recipe/structure/place_elements.h"

namespace lamella {

namespace {

constexpr int max_layers = 10'000'000;

int layers_of(double height, double layer_height, double lowest_plane) {
    if (height / layer_height > max_layers) {
        throw InputError(
            fmt::format("layers.height / --layer-height: {} mm cuts a part of {} mm into more than {} "
                        "layers; accepted: {} mm or more",
                        layer_height, height, max_layers, height / max_layers));
    }
    return count_layers(height, layer_height, lowest_plane);
}

/// Cuts the designed part's bounds into layers.
void set_layers(const Recipe& recipe, Job& job) {
    job.layer_height = designed_layer_height(recipe);
    // Masks that average several planes of a layer begin with the lowest of them.
    const double lowest_plane = 0.5 / std::max(1, recipe.printer.image.sub_layers);
    job.layer_count = layers_of(job.bounds.size().z * (recipe.layer_height / job.layer_height),
                                recipe.layer_height, lowest_plane);
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

/// Makes the foam's cells or members those of the optimisation.
void drive_foam(OptimizeResult result, const OptimizedPart& optimized, FoamRecipe& foam, Gradings& gradings) {
    const std::string name = "optimized_size";
    gradings.define(name, optimized.foam_sizes);
    GradedNumber& driven = result == OptimizeResult::cell ? foam.cell
                           : member_of(foam) == "wall"    ? foam.wall
                                                          : foam.beam;
    driven.value = name;
    if (driven.where.empty()) driven.where = "optimize.result";
}

}  // namespace

BuiltJob build_job(const Recipe& recipe, const OptimizeOptions& optimizing) {
    BuiltJob built;
    Gradings gradings(recipe);
    built.body = build_body(recipe, gradings, built.mesh);
    Job& job = built.designed;
    job.bounds = built.body->bounds();
    const std::string where = recipe.part.mesh.empty() ? "part" : recipe.part.mesh;
    if (job.bounds.empty()) throw InputError(where + ": the part is empty; a solid with a volume is needed");
    gradings.set_body(built.body);
    built.regions = build_regions(recipe, job.bounds, gradings, WhichRegions::before_search);
    std::optional<FoamRecipe> foam = recipe.foam;
    if (recipe.optimize) {
        built.optimized = optimize_part(recipe, built.body, built.regions, gradings, optimizing);
        built.body = built.optimized->shape;
        gradings.set_body(built.body);
        gradings.set_result({built.optimized->density, built.optimized->dense});
        if (built.regions.list.size() < recipe.regions.size()) {
            gradings.forget_overrides();
            built.regions = build_regions(recipe, job.bounds, gradings);
        }
        if (foam && built.optimized->foam_sizes)
            drive_foam(recipe.optimize->result, *built.optimized, *foam, gradings);
    }
    if (recipe.elements && !has_skin_of_elements(recipe)) {
        PlacedElements placed =
            place_elements(recipe, built.body, built.regions, gradings,
                           {optimizing.plans, optimizing.threads, optimizing.cancel, optimizing.on_elements});
        built.body = placed.shape;
        built.elements = std::move(placed.plan);
        gradings.set_body(built.body);
    }
    if (foam) built.foam = build_foam(*foam, job.bounds, gradings);
    set_layers(recipe, job);
    job.part = with_regions(
        fill_body(recipe, built, gradings,
                  {optimizing.plans, optimizing.threads, optimizing.cancel, optimizing.on_pattern}),
        built.body, recipe.foam || recipe.skin || recipe.optimize || recipe.elements, built.regions);
    if (built.pattern && built.pattern->elements) built.elements = std::move(built.pattern->elements);
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
