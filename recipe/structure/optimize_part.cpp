// A search or a kept result, and the fields that it becomes.
#include "recipe/structure/optimize_part.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/formula/formula_field.h"
#include "engine/formula/formula_parser.h"
#include "engine/mesh/mesh_field.h"
#include "engine/solids/csg.h"
#include "procedural/optimization/density_surface.h"
#include "procedural/volume/volume_grading.h"
#include "procedural/volume/write_nrrd.h"
#include "recipe/build/foam_modulus.h"
#include "recipe/identity.h"
#include "recipe/recipe_formulas.h"
#include "recipe/result_dependents.h"
#include "recipe/structure/optimized_foam.h"
#include "recipe/structure/pictured_plate.h"
#include "recipe/structure/stiffest_part.h"

namespace lamella {

namespace {

/// Returns the search's problem: the recipe without printer, layers and skin pattern, without what depends on
/// the result, and without the skin and foam that fill a solid shape once it is found. Foam regions belong to
/// the problem of a driven foam.
Recipe search_problem(const Recipe& recipe) {
    Recipe kept;
    const ResultDependents late(recipe);
    kept.part = recipe.part;
    std::ranges::copy_if(recipe.fields, std::back_inserter(kept.fields),
                         [&](const FieldRecipe& field) { return !late.fields.contains(field.name); });
    std::ranges::copy_if(recipe.gradings, std::back_inserter(kept.gradings),
                         [&](const GradingRecipe& grading) { return !late.gradings.contains(grading.name); });
    for (const RegionRecipe& region : recipe.regions) {
        const bool prescribes = region.make == RegionMake::solid || region.make == RegionMake::empty;
        const bool rules_foam = region.make == RegionMake::foam && drives_foam(recipe.optimize->result);
        if ((prescribes || rules_foam) && !late.fields.contains(region.field)) kept.regions.push_back(region);
    }
    if (drives_foam(recipe.optimize->result)) kept.foam = recipe.foam;
    kept.material = recipe.material;
    if (recipe.optimize->result != OptimizeResult::solid) kept.skin = recipe.skin;
    kept.loads = recipe.loads;
    kept.anchors = recipe.anchors;
    kept.optimize = recipe.optimize;
    return kept;
}

std::array<std::size_t, 3> sides(glm::ivec3 size) {
    return {static_cast<std::size_t>(size.x), static_cast<std::size_t>(size.y),
            static_cast<std::size_t>(size.z)};
}

/// Returns the sizes of cells or members (mm) that give densities, as a grading. Regions that set them do so
/// in the build of the foam; their elements go on with the sizes beside them, between which samples lie.
GradingPtr sizes_of_foam(const Recipe& recipe, Gradings& gradings, const DensityGrid& grid, const Box& box) {
    OptimizedFoam foam(recipe, gradings);
    const std::vector<FoamRange> ranges =
        foam.has_regions() ? foam.ranges_at(element_centres(grid.size, box)) : std::vector<FoamRange>();
    DensityGrid sizes{grid.size, std::vector(grid.density.size(), ElementUse::free),
                      std::vector<double>(grid.density.size())};
    parallel_for(grid.density.size(), [&](std::size_t i) {
        const FoamRange& range = ranges.empty() ? foam.without_regions() : ranges[i];
        if (range.is_kept) sizes.use[i] = ElementUse::outside;
        sizes.density[i] = foam.number_for(grid.density[i], range);
    });
    extend_outside(sizes, extended_layers);
    return make_volume_grading(
        Volume{sides(grid.size), std::vector<float>(sizes.density.begin(), sizes.density.end()), 1.0, box},
        box);
}

/// Whether distances from the shape are needed, which densities are not: by a skin, depths, blends of
/// regions.
bool needs_distances(const Recipe& recipe) {
    const auto blends = [](const RegionRecipe& region) {
        return region.blend > 0 && (region.make == RegionMake::solid || region.make == RegionMake::empty);
    };
    return recipe.skin || uses_depth(recipe) || std::ranges::any_of(recipe.regions, blends);
}

/// Makes grading and shape of the densities in single precision, as a plan keeps them.
void make_fields(const Recipe& recipe, const FieldPtr& body, std::vector<float> density,
                 OptimizedPart& part) {
    for (std::size_t i = 0; i < density.size(); ++i) part.grid.density[i] = static_cast<double>(density[i]);
    part.density =
        make_volume_grading(Volume{sides(part.grid.size), std::move(density), 1.0, part.box}, part.box);
    constexpr double level = 0.5;
    const std::vector<std::string> names{"x", "y", "z", "density"};
    part.dense = make_formula_field(parse_formula(fmt::format("{} - density", level), names), {part.density},
                                    body->bounds());
    part.shape = body;
    if (recipe.optimize->result != OptimizeResult::solid) return;
    FieldPtr shape = part.dense;
    if (needs_distances(recipe)) {
        // The stiffest part's elements are refined already.
        const int parts = recipe.optimize->kind == OptimizeKind::appearance ? 2 : 1;
        shape = make_mesh_field(
            close_mesh(density_surface(part.grid, part.box, level, parts), "the optimised shape"));
    }
    part.shape = make_intersection({body, std::move(shape)});
}

std::optional<OptimizedPart> kept_part(const std::filesystem::path& file, const Recipe& recipe,
                                       const FieldPtr& body) {
    std::error_code error;
    if (!std::filesystem::exists(file, error)) return std::nullopt;
    OptimizedPart part;
    std::vector<float> samples;
    try {
        Volume volume = read_volume(file.string());
        if (!volume.box || !std::holds_alternative<std::vector<float>>(volume.samples)) return std::nullopt;
        part.box = *volume.box;
        part.grid.size = {static_cast<int>(volume.size[0]), static_cast<int>(volume.size[1]),
                          static_cast<int>(volume.size[2])};
        samples = std::get<std::vector<float>>(std::move(volume.samples));
    } catch (const Error&) {
        return std::nullopt;  // a damaged plan is made anew
    }
    part.grid.density.resize(samples.size());
    make_fields(recipe, body, std::move(samples), part);
    return part;
}

}  // namespace

std::string optimize_hash(const Recipe& recipe) { return job_identity(search_problem(recipe)); }

OptimizedPart optimize_part(const Recipe& recipe, const FieldPtr& body, const BuiltRegions& regions,
                            Gradings& gradings, const OptimizeOptions& options) {
    const OptimizeResult result = recipe.optimize->result;
    const Recipe problem = search_problem(recipe);
    std::filesystem::path file, search;
    if (!options.plans.empty()) {
        const std::string hash = job_identity(problem);
        file = options.plans / (hash + ".nrrd");
        search = options.plans / (hash + ".search");
    }
    if (!file.empty() && !options.anew) {
        if (auto kept = kept_part(file, recipe, body)) {
            if (drives_foam(result))
                kept->foam_sizes = sizes_of_foam(recipe, gradings, kept->grid, kept->box);
            return std::move(*kept);
        }
    }
    ThreadArena arena(options.threads);
    const PartDesign design = arena.execute([&] {
        return problem.optimize->kind == OptimizeKind::appearance
                   ? pictured_plate(problem, *body, regions, gradings, options, search)
                   : stiffest_part(problem, *body, regions, gradings, options, search);
    });
    if (drives_foam(result)) note_bare_foam(recipe, *design.report);
    if (result == OptimizeResult::solid && (recipe.foam || recipe.skin))
        design.report->notes.emplace_back(
            "compliance is that of the solid shape; `lamella analyze` computes it as the shape is filled");
    OptimizedPart part;
    part.grid = design.grid;
    part.box = design.box;
    part.report = design.report;
    make_fields(recipe, body, {part.grid.density.begin(), part.grid.density.end()}, part);
    if (drives_foam(result)) part.foam_sizes = sizes_of_foam(recipe, gradings, part.grid, part.box);
    const bool is_whole = options.cancel == nullptr || !options.cancel->cancelled();
    if (!file.empty() && is_whole) {
        std::error_code error;
        std::filesystem::remove(search, error);
        std::filesystem::create_directories(options.plans, error);
        const std::vector<float> density(part.grid.density.begin(), part.grid.density.end());
        try {
            write_nrrd(file, sides(part.grid.size), density, part.box);
        } catch (const FaultError&) {  // as for supports: the next run makes it again
        }
    }
    return part;
}

}  // namespace lamella
