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
#include "procedural/volume/brick_file.h"
#include "procedural/volume/density_bricks.h"
#include "procedural/volume/volume_grading.h"
#include "recipe/build/foam_modulus.h"
#include "recipe/build/kept_plan.h"
#include "recipe/identity.h"
#include "recipe/placement/part_placement.h"
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
    kept.part = not_turned(recipe.part);
    std::ranges::copy_if(recipe.fields, std::back_inserter(kept.fields),
                         [&](const FieldRecipe& field) { return !late.fields.contains(field.name); });
    std::ranges::copy_if(recipe.gradings, std::back_inserter(kept.gradings),
                         [&](const GradingRecipe& grading) { return !late.gradings.contains(grading.name); });
    for (const RegionRecipe& region : recipe.regions) {
        const bool prescribes = region.make == RegionMake::solid || region.make == RegionMake::empty;
        const bool rules_foam = region.make == RegionMake::foam && drives_foam(recipe.optimize->result);
        if ((prescribes || rules_foam) && !late.fields.contains(region.field)) kept.regions.push_back(region);
    }
    if (drives_foam(recipe.optimize->result)) {
        kept.foam = recipe.foam;
        // Only that there is one counts: its beams may follow the result.
        if (recipe.frame) kept.frame.emplace();
    }
    kept.material = recipe.material;
    if (recipe.optimize->result != OptimizeResult::solid) kept.skin = recipe.skin;
    kept.loads = recipe.loads;
    kept.anchors = recipe.anchors;
    kept.optimize = recipe.optimize;
    return kept;
}

DensityGrid grid_of(const DensityBricks& bricks) {
    const std::vector<float> dense = bricks.dense();
    const VoxelIndex& size = bricks.size();
    return {{static_cast<int>(size[0]), static_cast<int>(size[1]), static_cast<int>(size[2])},
            {},
            {dense.begin(), dense.end()}};
}

DensityBricks bricks_of(const DensityGrid& grid, const Box& box) {
    const VoxelIndex size{static_cast<std::size_t>(grid.size.x), static_cast<std::size_t>(grid.size.y),
                          static_cast<std::size_t>(grid.size.z)};
    return {size, box, grid.density};
}

/// Returns the sizes of cells or members (mm) that give densities, as a grading. Regions that set them do so
/// in the build of the foam; their elements go on with the sizes beside them, between which samples lie.
GradingPtr sizes_of_foam(const Recipe& recipe, Gradings& gradings, const DensityBricks& densities) {
    OptimizedFoam foam(recipe, gradings);
    const auto graded = [](DensityBricks sizes) {
        return make_volume_grading(std::make_shared<const DensityBricks>(std::move(sizes)));
    };
    if (!foam.has_regions()) {
        return graded(densities.mapped([&](float density) {
            return static_cast<float>(foam.number_for(static_cast<double>(density), foam.without_regions()));
        }));
    }
    DensityGrid sizes = grid_of(densities);
    const std::vector<FoamRange> ranges = foam.ranges_at(element_centres(sizes.size, densities.box()));
    sizes.use.assign(sizes.density.size(), ElementUse::free);
    parallel_for(sizes.density.size(), [&](std::size_t i) {
        if (ranges[i].is_kept) sizes.use[i] = ElementUse::outside;
        sizes.density[i] = foam.number_for(sizes.density[i], ranges[i]);
    });
    extend_outside(sizes, extended_layers);
    return graded(bricks_of(sizes, densities.box()));
}

/// Whether distances from the shape are needed, which densities are not: by a skin, depths, blends of
/// regions.
bool needs_distances(const Recipe& recipe) {
    const auto blends = [](const RegionRecipe& region) {
        return region.blend > 0 && (region.make == RegionMake::solid || region.make == RegionMake::empty);
    };
    return recipe.skin || uses_depth(recipe) || std::ranges::any_of(recipe.regions, blends);
}

/// Returns gradings and shape of the densities.
OptimizedPart part_of(const Recipe& recipe, const FieldPtr& body, Gradings& gradings,
                      DensityBricks densities) {
    OptimizedPart part;
    part.densities = std::make_shared<const DensityBricks>(std::move(densities));
    part.density = make_volume_grading(part.densities);
    constexpr double level = 0.5;
    const std::vector<std::string> names{"x", "y", "z", "density"};
    part.dense = make_formula_field(parse_formula(fmt::format("{} - density", level), names), {part.density},
                                    body->bounds());
    part.shape = body;
    if (drives_foam(recipe.optimize->result))
        part.foam_sizes = sizes_of_foam(recipe, gradings, *part.densities);
    if (recipe.optimize->result != OptimizeResult::solid) return part;
    FieldPtr shape = part.dense;
    if (needs_distances(recipe)) {
        // The stiffest part's elements are refined already.
        const int parts = recipe.optimize->kind == OptimizeKind::appearance ? 2 : 1;
        shape = make_mesh_field(
            close_mesh(density_surface(grid_of(*part.densities), part.densities->box(), level, parts),
                       "the optimised shape"));
    }
    part.shape = make_intersection({body, std::move(shape)});
    return part;
}

std::filesystem::path kept_file(const std::filesystem::path& plans, const std::string& hash) {
    return plans / (hash + ".bricks");
}

}  // namespace

std::string optimize_hash(const Recipe& recipe) { return job_identity(search_problem(recipe)); }

bool has_optimized(const Recipe& recipe, const std::filesystem::path& plans) {
    if (plans.empty()) return false;
    return read_kept(kept_file(plans, optimize_hash(recipe)), read_bricks).has_value();
}

OptimizedPart optimize_part(const Recipe& recipe, const FieldPtr& body, const BuiltRegions& regions,
                            Gradings& gradings, const OptimizeOptions& options) {
    const OptimizeResult result = recipe.optimize->result;
    const Recipe problem = search_problem(recipe);
    std::filesystem::path file, search;
    if (!options.plans.empty()) {
        const std::string hash = job_identity(problem);
        file = kept_file(options.plans, hash);
        search = options.plans / (hash + ".search");
    }
    if (!file.empty() && !options.anew) {
        if (auto kept = read_kept(file, read_bricks))
            return part_of(recipe, body, gradings, std::move(*kept));
    }
    ThreadArena arena(options.threads);
    PartDesign design = arena.execute([&] {
        return problem.optimize->kind == OptimizeKind::appearance
                   ? pictured_plate(problem, *body, regions, gradings, options, search)
                   : stiffest_part(problem, *body, regions, gradings, options, search);
    });
    if (drives_foam(result)) note_bare_foam(recipe, *design.report);
    if (result == OptimizeResult::solid && (recipe.foam || recipe.skin))
        design.report->notes.emplace_back(
            "compliance is that of the solid shape; `lamella analyze` computes it as the shape is filled");
    DensityBricks densities = bricks_of(design.grid, design.box);
    design.grid.density = {};
    const bool is_whole = options.cancel == nullptr || !options.cancel->cancelled();
    if (!file.empty() && is_whole) {
        std::error_code error;
        std::filesystem::remove(search, error);
        keep_if_possible(file, [&](const std::filesystem::path& to) { write_bricks(to, densities); });
    }
    OptimizedPart part = part_of(recipe, body, gradings, std::move(densities));
    part.use = std::move(design.grid.use);
    part.report = design.report;
    return part;
}

}  // namespace lamella
