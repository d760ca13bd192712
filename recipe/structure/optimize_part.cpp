// Problem, loop, shape, and the analysis of the shape.
#include "recipe/structure/optimize_part.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/formula/formula_field.h"
#include "engine/formula/formula_parser.h"
#include "engine/solids/csg.h"
#include "procedural/volume/volume_grading.h"
#include "procedural/volume/write_nrrd.h"
#include "recipe/build/foam_modulus.h"
#include "recipe/identity.h"
#include "recipe/structure/optimized_foam.h"
#include "recipe/structure/structural_problem.h"
#include "recipe/structure/structure_report.h"

namespace lamella {

namespace {

template <std::size_t Dim>
constexpr double void_modulus_of = Dim == 2 ? 1e-9 : 1e-6;
constexpr double least_radius = 1.5;  // elements; below, checkerboards
/// Layers of elements outside the body that continue its densities: as far as trilinear samples reach.
constexpr int extended_layers = 2;
constexpr double pedersen_to = 0.1;  // density below which self-weight is carried linearly

DensitySettings density_settings(const OptimizeRecipe& optimize, const ElementDomain& domain) {
    DensitySettings settings;
    settings.radius = std::max(least_radius, optimize.radius / domain.edge);
    if (optimize.member > 0 || optimize.gap > 0) {
        settings.length_scale = length_scale_for({.member = optimize.member,
                                                  .gap = optimize.gap,
                                                  .element = domain.edge,
                                                  .dimensions = domain.dimensions});
    }
    for (const char axis : optimize.symmetry) settings.mirrored[static_cast<std::size_t>(axis - 'x')] = true;
    if (optimize.overhang) settings.overhang.emplace();
    return settings;
}

TopologySettings topology_settings(const OptimizeRecipe& optimize, const ElementDomain& domain,
                                   const CancelToken* cancel) {
    TopologySettings settings;
    settings.density = density_settings(optimize, domain);
    // Under self-weight a compliance may grow with the volume, which optimality criteria cannot follow.
    const bool needs_mma = optimize.method == OptimizeMethod::mma || optimize.gravity != dvec3(0);
    settings.method = needs_mma ? TopologyMethod::mma : TopologyMethod::oc;
    settings.tolerance = optimize.tolerance;
    settings.iterations = optimize.iterations;
    settings.sharpness = optimize.result == OptimizeResult::solid ? optimize.sharpness : 0;
    settings.cancel = cancel;
    return settings;
}

/// The share of the body that material may fill.
double volume_bound(const OptimizeRecipe& optimize, const ElementDomain& domain,
                    const BaseMaterial& material) {
    if (optimize.mass == 0) return optimize.volume;
    const double full =
        1e-3 * material.density * domain.element_volume() * static_cast<double>(domain.elements());
    if (optimize.mass >= full)
        throw InputError(
            fmt::format("optimize.mass / --optimize-mass: {} g is no less than the whole part's {:.4g} g; "
                        "accepted: less",
                        optimize.mass, full));
    return optimize.mass / full;
}

/// Returns what the optimisation leaves the same when it changes: the recipe without printer, layers and skin
/// pattern.
Recipe relevant(const Recipe& recipe) {
    Recipe kept;
    kept.part = recipe.part;
    kept.fields = recipe.fields;
    kept.gradings = recipe.gradings;
    kept.regions = recipe.regions;
    kept.foam = recipe.foam;
    kept.material = recipe.material;
    kept.skin = recipe.skin;
    kept.loads = recipe.loads;
    kept.anchors = recipe.anchors;
    kept.optimize = recipe.optimize;
    return kept;
}

std::array<std::size_t, 3> sides(glm::ivec3 size) {
    return {static_cast<std::size_t>(size.x), static_cast<std::size_t>(size.y),
            static_cast<std::size_t>(size.z)};
}

/// Returns the sizes of cells or members (mm) that give densities, as a grading.
GradingPtr sizes_of_foam(const OptimizedFoam& foam, const DensityGrid& grid, const Box& box) {
    std::vector<float> sizes;
    sizes.reserve(grid.density.size());
    for (const double density : grid.density) sizes.push_back(static_cast<float>(foam.number_for(density)));
    return make_volume_grading(Volume{sides(grid.size), std::move(sizes), 1.0, box}, box);
}

/// Makes grading and shape of the densities in single precision, as a plan keeps them.
void make_fields(const FieldPtr& body, bool is_foam, std::vector<float> density, OptimizedPart& part) {
    for (std::size_t i = 0; i < density.size(); ++i) part.grid.density[i] = static_cast<double>(density[i]);
    part.density =
        make_volume_grading(Volume{sides(part.grid.size), std::move(density), 1.0, part.box}, part.box);
    part.shape = body;
    if (is_foam) return;
    constexpr double level = 0.5;
    const std::vector<std::string> names{"x", "y", "z", "density"};
    const FieldPtr dense = make_formula_field(parse_formula(fmt::format("{} - density", level), names),
                                              {part.density}, body->bounds());
    part.shape = make_intersection({body, dense});
}

/// One optimisation, in the plane or in space.
template <std::size_t Dim>
class PartOptimizer {
  public:
    PartOptimizer(const Recipe& recipe, ElementDomain domain, Gradings& gradings,
                  const OptimizeOptions& options)
        : recipe_(recipe), options_(options), domain_(std::move(domain)) {
        if (recipe.optimize->result != OptimizeResult::solid) foam_.emplace(recipe);
        problem_.emplace(
            structural_problem<Dim>(recipe, domain_, gradings, foam_ ? foam_->poisson() : unknown_poisson));
        const OptimizeRecipe& optimize = *recipe.optimize;
        TopologyProblem<Dim>& topology = problem_->topology;
        topology.volume = volume_bound(optimize, domain_, problem_->material);
        if (foam_) {
            topology.law = foam_->law();
            topology.least_density = foam_->densities().lo;
            topology.greatest_density = foam_->densities().hi;
            foam_->check_volume(topology.volume);
        } else {
            const bool is_heavy = optimize.gravity != dvec3(0);
            topology.law =
                make_penalty_law({optimize.penalty, void_modulus_of<Dim>, is_heavy ? pedersen_to : 0});
        }
    }

    OptimizedPart optimize(const FieldPtr& body);

  private:
    static constexpr double unknown_poisson = -1;

    DensityGrid shaped(TopologyOptimizer<Dim>& optimizer, StructureReport& report) const;

    const Recipe& recipe_;
    const OptimizeOptions& options_;
    ElementDomain domain_;
    std::optional<OptimizedFoam> foam_;
    std::optional<StructuralProblem<Dim>> problem_;
};

/// Cuts the densities at the level that keeps their volume, and drops stray pieces.
template <std::size_t Dim>
DensityGrid PartOptimizer<Dim>::shaped(TopologyOptimizer<Dim>& optimizer, StructureReport& report) const {
    // The filtered field is smooth, and says where the projected one is solid. What the overhang filter
    // leaves is known only behind it.
    const DensityMap& densities = optimizer.densities();
    const auto printed = densities.density(DensityMap::Role::result);
    const bool is_smooth = !recipe_.optimize->overhang;
    DensityGrid grid{
        domain_.size, domain_.use,
        is_smooth ? densities.smooth_density() : std::vector<double>(printed.begin(), printed.end())};
    if (foam_) {
        extend_outside(grid, extended_layers);
        return grid;
    }
    const double volume = std::min(report.history.back().volume, problem_->topology.volume);
    extend_outside(grid, extended_layers);
    double level = volume_keeping_level(grid, volume);
    const StrayPieces stray = drop_stray_pieces(grid, level, problem_->anchored, problem_->loaded);
    report.stray_pieces = stray.pieces;
    if (stray.pieces > 0) {
        extend_outside(grid, extended_layers);
        level = volume_keeping_level(grid, volume);
    }
    for (double& d : grid.density) d += 0.5 - level;
    return grid;
}

template <std::size_t Dim>
OptimizedPart PartOptimizer<Dim>::optimize(const FieldPtr& body) {
    OptimizedPart part;
    const auto made = std::make_shared<StructureReport>();
    part.report = made;
    StructureReport& report = *made;
    describe(*problem_, domain_, report);
    TopologyOptimizer<Dim> optimizer(problem_->topology,
                                     topology_settings(*recipe_.optimize, domain_, options_.cancel));
    while (!optimizer.is_finished()) {
        try {
            report.history.push_back(optimizer.iterate());
            report.history.back().compliance *= problem_->displacement_unit;
            if (foam_) report.history.back().greyness = 0;  // every density of a foam is printable
        } catch (const Interrupted&) {
            if (report.history.empty()) throw;
            break;
        }
        if (options_.on_iteration) options_.on_iteration(report.history.back(), recipe_.optimize->iterations);
    }
    optimizer.show_design();
    const TopologyIteration& last = report.history.back();
    report.is_converged = optimizer.is_finished() && last.change < recipe_.optimize->tolerance;
    report.densities_compliance = last.compliance;
    report.greyness = last.greyness;
    part.grid = shaped(optimizer, report);
    part.box = domain_.box;
    // A cut element counts by its solid share.
    const auto law = foam_ ? problem_->topology.law : make_penalty_law({1, void_modulus_of<Dim>, 0});
    analyse(*problem_, domain_, law, foam_ ? part.grid.density : solid_shares(part.grid, 0.5),
            foam_.has_value(), nullptr, report);
    make_fields(body, foam_.has_value(), {part.grid.density.begin(), part.grid.density.end()}, part);
    return part;
}

std::optional<OptimizedPart> kept_part(const std::filesystem::path& file, const FieldPtr& body,
                                       bool is_foam) {
    std::error_code error;
    if (!std::filesystem::exists(file, error)) return std::nullopt;
    try {
        Volume volume = read_volume(file.string());
        if (!volume.box || !std::holds_alternative<std::vector<float>>(volume.samples)) return std::nullopt;
        OptimizedPart part;
        part.box = *volume.box;
        part.grid.size = {static_cast<int>(volume.size[0]), static_cast<int>(volume.size[1]),
                          static_cast<int>(volume.size[2])};
        auto samples = std::get<std::vector<float>>(std::move(volume.samples));
        part.grid.density.resize(samples.size());
        make_fields(body, is_foam, std::move(samples), part);
        return part;
    } catch (const Error&) {
        return std::nullopt;  // a damaged plan is made anew
    }
}

}  // namespace

std::string optimize_hash(const Recipe& recipe) { return job_identity(relevant(recipe)); }

OptimizedPart optimize_part(const Recipe& recipe, const FieldPtr& body, const BuiltRegions& regions,
                            Gradings& gradings, const OptimizeOptions& options) {
    if (recipe.optimize->kind == OptimizeKind::appearance)
        throw InputError(
            "optimize.kind / --optimize-kind: \"appearance\" is read, but not made yet; accepted: stiffness");
    const bool is_foam = recipe.optimize->result != OptimizeResult::solid;
    const std::filesystem::path file =
        options.plans.empty() ? std::filesystem::path() : options.plans / (optimize_hash(recipe) + ".nrrd");
    if (!file.empty() && !options.anew) {
        if (auto kept = kept_part(file, body, is_foam)) {
            if (is_foam) kept->foam_sizes = sizes_of_foam(OptimizedFoam(recipe), kept->grid, kept->box);
            return std::move(*kept);
        }
    }
    ThreadArena arena(options.threads);
    OptimizedPart part = arena.execute([&] {
        ElementDomain domain = element_domain(recipe, *body, regions, options.cancel);
        if (domain.dimensions == 2)
            return PartOptimizer<2>(recipe, std::move(domain), gradings, options).optimize(body);
        return PartOptimizer<3>(recipe, std::move(domain), gradings, options).optimize(body);
    });
    if (is_foam) part.foam_sizes = sizes_of_foam(OptimizedFoam(recipe), part.grid, part.box);
    const bool is_whole = options.cancel == nullptr || !options.cancel->cancelled();
    if (!file.empty() && is_whole) {
        std::error_code error;
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
