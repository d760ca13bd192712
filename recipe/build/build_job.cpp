// The order of things: body, depths below it, foam, skin, layers, process.
#include "recipe/build/build_job.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/box_image.h"
#include "engine/base/error.h"
#include "engine/layers/survey_rows.h"
#include "engine/solids/box_solid.h"
#include "engine/solids/csg.h"
#include "recipe/build/build_process.h"
#include "recipe/build/fill_body.h"
#include "recipe/identity.h"
#include "recipe/pieces/cut_part.h"
#include "recipe/pieces/section_bounds.h"
#include "recipe/placement/part_placement.h"
#include "recipe/structure/place_elements.h"

namespace lamella {

namespace {

/// Returns the heights at which regions have layers of their own: those of what they hold of the part.
std::vector<HeightBand> height_bands(const Recipe& recipe, const Job& outer, const BuiltRegions& regions) {
    std::vector<HeightBand> bands;
    for (const BuiltRegion& region : regions.list) {
        if (region.layer_height == 0) continue;
        const FieldPtr held = make_scaled(recipe, outer, make_intersection({region.field, outer.part}));
        const Box box = held->bounds().empty() ? Box() : section_bounds(*held);
        constexpr double beyond = 0.001;  // mm: by how much section_bounds() may enclose more
        if (!box.empty()) bands.push_back({{box.lo.z, box.hi.z - beyond}, region.layer_height});
    }
    return bands;
}

/// Cuts the part into layers: the solid within its outer surface, as it will be scaled.
void set_layers(const Recipe& recipe, const OptimizeOptions& optimizing, BuiltJob& built) {
    Job outer = built.designed;
    outer.part = built.outside;
    built.layers =
        part_layers(recipe, make_scaled(recipe, outer, LayerPlan()),
                    height_bands(recipe, outer, built.regions), {optimizing.threads, {}, optimizing.cancel});
    built.designed.layers = designed_layers(recipe, built.layers.plan);
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

/// Optimises the body or builds it of elements, as the recipe asks, and returns the foam for it.
std::optional<FoamRecipe> design(const Recipe& recipe, const OptimizeOptions& optimizing, BuiltJob& built,
                                 Gradings& gradings) {
    std::optional<FoamRecipe> foam = recipe.foam;
    if (recipe.optimize) {
        built.optimized = optimize_part(recipe, built.body, built.regions, gradings, optimizing);
        built.body = built.optimized->shape;
        gradings.set_body(built.body);
        gradings.set_result({built.optimized->density, built.optimized->dense});
        if (built.regions.list.size() < recipe.regions.size()) {
            gradings.forget_overrides();
            built.regions = build_regions(recipe, built.designed.bounds, gradings);
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
    return foam;
}

/// Turns the designed body and the regions into the job's space. Gradings stay those of the designed part. A
/// body that no search has changed is made anew, since turned meshes and shapes are exact.
void turn(const Recipe& recipe, const OptimizeOptions& optimizing, BuiltJob& built, Gradings& gradings) {
    if (optimizing.as_designed) return;
    built.axes = part_axes(recipe.part);
    if (built.axes == glm::dmat3(1)) return;
    if (recipe.optimize && recipe.optimize->overhang && built.axes[2] != dvec3(0, 0, 1)) {
        throw InputError(
            "optimize.overhang: the part was optimised to be printed as it was designed, but is turned; "
            "accepted: a turn about z alone, or no limit of overhangs");
    }
    const bool is_as_given = !built.optimized && !built.elements;
    built.body = is_as_given ? build_body(recipe, gradings, built.mesh, built.axes)
                             : make_transform(built.body, built.axes, dvec3(0));
    const bool is_exact = is_as_given && recipe.part.field.empty() && recipe.part.shape != Shape::gyroid;
    built.designed.bounds = is_exact ? built.body->bounds() : tight_bounds(*built.body);
    built.regions = turned_regions(recipe, built.designed.bounds, gradings, built.axes);
}

/// Replaces the part by the piece that the recipe names.
void cut(const Recipe& recipe, const OptimizeOptions& optimizing, BuiltJob& built) {
    if (recipe.cuts.empty()) return;
    std::vector<CutPlane> planes;
    for (const CutRecipe& cut : recipe.cuts) planes.push_back(plane_of(cut, built.axes));
    const std::vector<PieceSides> pieces = pieces_of(built.outside, recipe.cuts, planes);
    built.pieces = static_cast<int>(pieces.size());
    if (recipe.plate.piece == 0) return;
    if (recipe.plate.piece > built.pieces) {
        throw InputError(
            fmt::format("plate.piece / --piece: {}, but the cuts make {} of the part; accepted: 1 to {}",
                        recipe.plate.piece, built.pieces, built.pieces));
    }
    const CutPiece piece(recipe.cuts, planes, pieces, static_cast<std::size_t>(recipe.plate.piece - 1),
                         built.outside);
    Job& job = built.designed;
    job.part = piece.of(job.part);
    if (built.before_cavities) built.before_cavities = piece.of(built.before_cavities);
    built.outside = piece.of(built.outside);
    job.bounds = section_bounds(*built.outside);
    set_layers(recipe, optimizing, built);
}

/// Returns the spaces of a foam that stays fixed to the part or to the bed.
FoamPlace foam_place(const FoamRecipe& foam, const Recipe& recipe, const Box& designed,
                     const BuiltJob& built) {
    if (foam.frame == FoamFrame::part)
        return {designed, glm::dmat3(1), built.axes, built.designed.bounds, built.body};
    const glm::dmat3 to_bed = part_axes(recipe.part);
    if (built.axes == to_bed) return {built.designed.bounds, to_bed, glm::dmat3(1), {}, built.body};
    return {image_of(designed, to_bed), to_bed, glm::transpose(to_bed), designed, built.body};
}

}  // namespace

BuiltJob build_job(const Recipe& given, const OptimizeOptions& optimizing) {
    const Recipe recipe = with_known_placement(given);
    BuiltJob built;
    Gradings gradings(recipe, optimizing.inputs);
    built.body = build_body(recipe, gradings, built.mesh);
    Job& job = built.designed;
    job.bounds = built.body->bounds();
    const std::string where = recipe.part.mesh.empty() ? "part" : recipe.part.mesh;
    if (job.bounds.empty()) throw InputError(where + ": the part is empty; a solid with a volume is needed");
    gradings.set_body(built.body);
    built.regions = build_regions(recipe, job.bounds, gradings, WhichRegions::before_search);
    const std::optional<FoamRecipe> foam = design(recipe, optimizing, built, gradings);
    const Box designed_bounds = job.bounds;
    turn(recipe, optimizing, built, gradings);
    if (foam) built.foam = build_foam(*foam, foam_place(*foam, recipe, designed_bounds, built), gradings);
    built.outside = built.body;
    set_layers(recipe, optimizing, built);
    job.part = with_regions(
        fill_body(recipe, built, gradings,
                  {optimizing.plans, optimizing.threads, optimizing.cancel, optimizing.on_pattern}),
        built.body, recipe.foam || recipe.skin || recipe.optimize || recipe.elements, built.regions);
    if (built.pattern && built.pattern->elements) built.elements = std::move(built.pattern->elements);
    if (recipe.skin && recipe.skin->side != SkinSide::inside) {
        built.outside = make_union({built.body, job.part});
        job.bounds = built.outside->bounds();
        set_layers(recipe, optimizing, built);
    }
    if (recipe.cavity) {
        built.before_cavities = job.part;
        built.cavities = hollow_out(recipe, job, built.layers.plan.least_height());
    }
    if (asks_for_dowels(recipe)) {
        built.dowels = place_dowels(recipe, job);
        job.part = without_dowels(job.part, *built.dowels);
    }
    cut(recipe, optimizing, built);
    job.name = recipe.part.name;
    if (recipe.plate.piece > 0) job.name += fmt::format("_{}", recipe.plate.piece);
    job.identity = job_identity(given, optimizing.inputs);
    if (built.foam && built.foam->modulus) {
        built.modulus = modulus_report(*built.foam->modulus, *built.body);
        job.notes = modulus_lines(*built.modulus);
    }
    built.job = make_processed(recipe, job, built.layers.plan);
    return built;
}

Recipe first_piece(const Recipe& recipe) {
    Recipe first = recipe;
    if (!recipe.cuts.empty() && recipe.plate.piece == 0) first.plate.piece = 1;
    return first;
}

std::vector<Recipe> other_pieces(const Recipe& recipe, int pieces) {
    if (recipe.cuts.empty() || recipe.plate.piece > 0) return {};
    std::vector<Recipe> others(static_cast<std::size_t>(pieces - 1), recipe);
    for (int i = 2; i <= pieces; ++i) others[static_cast<std::size_t>(i - 2)].plate.piece = i;
    return others;
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
    built.job = make_processed(recipe, built.designed, built.layers.plan);
}

BuiltFoam build_foam_alone(const Recipe& recipe, const Box& region, std::int64_t repeats_after) {
    if (recipe.frame) {
        throw InputError(
            recipe.frame->beam.where +
            ": a frame follows the part's surface, and there is no part; accepted: [part] with it");
    }
    Gradings gradings(recipe);
    build_regions(recipe, region, gradings);
    return build_foam(*recipe.foam, {.region = region}, gradings, repeats_after);
}

}  // namespace lamella
