// Problem, loop, shape, and the analysis of the shape.
#include "recipe/structure/stiffest_part.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/base/error.h"
#include "procedural/elasticity/cut_cells.h"
#include "procedural/optimization/overhang_shape.h"
#include "recipe/structure/bare_faces.h"
#include "recipe/structure/design_settings.h"
#include "recipe/structure/loaded_elements.h"
#include "recipe/structure/optimized_foam.h"
#include "recipe/structure/stopped_search.h"
#include "recipe/structure/structural_problem.h"

namespace lamella {

namespace {

TopologySettings topology_settings(const OptimizeRecipe& optimize, const ElementDomain& domain,
                                   const CancelToken* cancel) {
    TopologySettings settings;
    settings.density = density_settings(optimize, domain);
    // Under self-weight a compliance may grow with the volume, which optimality criteria cannot follow.
    const bool needs_mma = optimize.method == OptimizeMethod::mma || optimize.gravity != dvec3(0);
    settings.method = needs_mma ? TopologyMethod::mma : TopologyMethod::oc;
    settings.tolerance = optimize.tolerance;
    if (optimize.iterations > 0) settings.iterations = optimize.iterations;
    settings.sharpness = drives_foam(optimize.result) ? 0 : optimize.sharpness;
    settings.cancel = cancel;
    return settings;
}

/// One search, in the plane or in space.
template <std::size_t Dim>
class PartOptimizer {
  public:
    PartOptimizer(const Recipe& recipe, const Field& body, ElementDomain domain, Gradings& gradings,
                  const OptimizeOptions& options, const std::filesystem::path& file)
        : recipe_(recipe), options_(options), file_(file), domain_(std::move(domain)) {
        if (drives_foam(recipe.optimize->result)) foam_.emplace(recipe, gradings);
        problem_.emplace(
            structural_problem<Dim>(recipe, domain_, gradings, foam_ ? foam_->poisson() : material_poisson));
        const OptimizeRecipe& optimize = *recipe.optimize;
        TopologyProblem<Dim>& topology = problem_->topology;
        topology.volume = volume_bound(optimize, domain_, problem_->material);
        if (foam_) {
            topology.law = foam_->law();
            topology.least_density = foam_->densities().lo;
            topology.greatest_density = foam_->densities().hi;
            std::vector<FoamRange> ranges;
            if (foam_->has_regions()) ranges = limit_by_regions();
            if (softens_at_faces(recipe)) soften_faces(body, ranges);
            const Interval volumes = foam_volumes();
            if (optimize.kind == OptimizeKind::lightness)
                topology.volume = std::min(topology.volume, OptimizeRecipe::whole_part * volumes.hi);
            foam_->check_volume(topology.volume, volumes);
        } else {
            topology.law = penalty_law<Dim>(optimize);
            // As thick as the thinnest member may be. Under an overhang limit they would hang in the air.
            if (!optimize.overhang)
                make_loads_solid(optimize.member / domain_.shortest_edge() - 1, domain_, *problem_);
            check_solid_share();
        }
    }

    PartDesign optimize();

  private:
    std::vector<FoamRange> limit_by_regions();
    void soften_faces(const Field& body, std::span<const FoamRange> ranges);
    Interval foam_volumes() const;
    double share_of(ElementUse use) const;
    void check_solid_share() const;
    double full_compliance() const;
    DensityGrid cut(const DensityGrid& extended, int factor, double volume, StructureReport& report) const;
    void cut_to_bound(DensityGrid found, PartDesign& design) const;
    void search(TopologyOptimizer<Dim>& optimizer, int iterations, StructureReport& report) const;
    DensityGrid densities(const DensityMap& found) const;
    std::vector<std::uint8_t> far_from_holds(double radius) const;
    std::vector<std::uint8_t> of_parts(const std::vector<std::uint8_t>& flags, int factor) const;

    const Recipe& recipe_;
    const OptimizeOptions& options_;
    const std::filesystem::path& file_;  ///< of a search that is stopped
    ElementDomain domain_;
    std::optional<OptimizedFoam> foam_;
    std::optional<StructuralProblem<Dim>> problem_;
};

/// Gives each element the densities and the law that the foam has there, and returns the range of each.
template <std::size_t Dim>
std::vector<FoamRange> PartOptimizer<Dim>::limit_by_regions() {
    TopologyProblem<Dim>& topology = problem_->topology;
    const std::vector<dvec3> places = element_centres(domain_.size, domain_.box);
    std::vector<FoamRange> ranges = foam_->ranges_at(places);
    topology.limits.assign(places.size(), Interval{0, 0});
    topology.law_of.assign(places.size(), 0);
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (domain_.use[i] != ElementUse::free) continue;
        foam_->check(ranges[i], places[i]);
        topology.limits[i] = ranges[i].densities;
        topology.law_of[i] = static_cast<std::uint32_t>(ranges[i].law);
        if (ranges[i].is_kept) domain_.use[i] = topology.use[i] = ElementUse::kept;
    }
    topology.laws = foam_->laws();
    if (std::ranges::count(domain_.use, ElementUse::free) == 0)
        throw InputError(
            "optimize.result: regions leave no foam to the search: they set its driven number everywhere, or "
            "are solid or empty; accepted: regions of some of the part");
    return ranges;
}

/// Gives elements near bare faces a softer law. `ranges` is empty for a foam without regions.
template <std::size_t Dim>
void PartOptimizer<Dim>::soften_faces(const Field& body, std::span<const FoamRange> ranges) {
    TopologyProblem<Dim>& topology = problem_->topology;
    double cell = foam_->largest_cell(foam_->without_regions());
    for (const FoamRange& range : ranges) cell = std::max(cell, foam_->largest_cell(range));
    const std::vector<Interval> depths =
        depths_below_faces(body, domain_, problem_->anchored_or_loaded(), cut_cells_depth(cell));
    topology.law_of.resize(depths.size(), 0);
    for (std::size_t i = 0; i < depths.size(); ++i) {
        if (depths[i].lo == infinity) continue;
        const FoamRange& range = ranges.empty() ? foam_->without_regions() : ranges[i];
        topology.law_of[i] = static_cast<std::uint32_t>(foam_->law_below_face(range, depths[i]));
    }
    topology.laws = foam_->laws();
}

/// Returns the volumes of the part with the sparsest foam and with the densest.
template <std::size_t Dim>
Interval PartOptimizer<Dim>::foam_volumes() const {
    const TopologyProblem<Dim>& topology = problem_->topology;
    const double solid = share_of(ElementUse::solid);
    if (topology.limits.empty()) {
        const double free = share_of(ElementUse::free);
        return {solid + free * foam_->densities().lo, solid + free * foam_->densities().hi};
    }
    double least = 0, greatest = 0;
    for (const Interval& limits : topology.limits) {
        least += limits.lo;
        greatest += limits.hi;
    }
    const auto elements = static_cast<double>(domain_.elements());
    return {solid + least / elements, solid + greatest / elements};
}

/// Iterates to the end, or until it is cancelled.
template <std::size_t Dim>
void PartOptimizer<Dim>::search(TopologyOptimizer<Dim>& optimizer, int iterations,
                                StructureReport& report) const {
    if (options_.resume) optimizer.set_state(kept_search<TopologyState>(file_, report));
    while (!optimizer.is_finished()) {
        try {
            OptimizationStep step{optimizer.iterate()};
            step.compliance *= problem_->displacement_unit;
            if (foam_) step.greyness = 0;  // every density of a foam is printable
            report.history.push_back(step);
        } catch (const Interrupted&) {
            if (report.history.empty()) throw;
            keep_search(file_, optimizer.state(), report);
            break;
        }
        if (options_.on_iteration) options_.on_iteration(report.history.back(), iterations);
        if (options_.on_design) {
            options_.on_design({domain_.size, domain_.box, &domain_.use, [&] {
                                    optimizer.show_design();
                                    return densities(optimizer.densities()).density;
                                }});
        }
    }
    optimizer.show_design();
    const OptimizationStep& last = report.history.back();
    report.is_converged = optimizer.is_finished() && last.change < recipe_.optimize->tolerance;
    report.densities_compliance = last.compliance;
    report.greyness = last.greyness;
}

/// The filtered field is smooth, and says where the projected one is solid. What the overhang filter leaves
/// is known only behind it.
template <std::size_t Dim>
DensityGrid PartOptimizer<Dim>::densities(const DensityMap& found) const {
    const auto printed = found.density(DensityMap::Role::result);
    const bool is_smooth = !recipe_.optimize->overhang;
    return {domain_.size, domain_.use,
            is_smooth ? found.smooth_density() : std::vector<double>(printed.begin(), printed.end())};
}

/// Returns the elements that neither a support nor a load is near to: there, the body goes on in what holds
/// or loads it, and a member ends at the border without becoming thin.
template <std::size_t Dim>
std::vector<std::uint8_t> PartOptimizer<Dim>::far_from_holds(double radius) const {
    std::vector<std::uint8_t> flags = elements_near(domain_.size, problem_->anchored_or_loaded(), radius);
    for (std::uint8_t& flag : flags) flag = flag == 0;
    return flags;
}

/// Returns flags of elements for the parts of a refined grid.
template <std::size_t Dim>
std::vector<std::uint8_t> PartOptimizer<Dim>::of_parts(const std::vector<std::uint8_t>& flags,
                                                       int factor) const {
    if (factor == 1) return flags;
    const DensityGrid grid{domain_.size, {}, {}}, fine{factor * domain_.size, {}, {}};
    std::vector<std::uint8_t> parts(fine.place({0, 0, fine.size.z}));
    for (std::size_t i = 0; i < parts.size(); ++i) parts[i] = flags[grid.place(fine.element(i) / factor)];
    return parts;
}

/// Returns into how many parts elements are cut along each axis: six for a shape without overhangs, else
/// three, as long as the parts are few.
int refinement(glm::ivec3 size, bool overhang) {
    const double most_parts = overhang ? 16e6 : 4e6;
    const double elements = static_cast<double>(size.x) * size.y * size.z;
    const double parts = most_parts / elements, along = size.z == 1 ? std::sqrt(parts) : std::cbrt(parts);
    return std::clamp(static_cast<int>(along), 1, overhang ? 6 : 3);
}

/// Returns the share of the body's elements with this use.
template <std::size_t Dim>
double PartOptimizer<Dim>::share_of(ElementUse use) const {
    return static_cast<double>(std::ranges::count(domain_.use, use)) /
           static_cast<double>(domain_.elements());
}

template <std::size_t Dim>
void PartOptimizer<Dim>::check_solid_share() const {
    const double solid = share_of(ElementUse::solid), most = problem_->topology.volume;
    if (solid < most) return;
    throw InputError(fmt::format(
        "optimize.volume / --optimize-volume: solid regions and the elements under loads fill "
        "{:.3g} of the part, its material may fill {:.3g}; accepted: more volume, smaller elements, "
        "or loads on less of the part",
        solid, most));
}

/// Returns the compliance with material everywhere, as the search measures it.
template <std::size_t Dim>
double PartOptimizer<Dim>::full_compliance() const {
    TopologyProblem<Dim> full = problem_->topology;
    if (!foam_) full.law = make_penalty_law({1, void_modulus_of<Dim>, 0});
    Compliance<Dim> compliance(full, {.tolerance = 1e-6, .cancel = options_.cancel});
    return compliance.evaluate(full_densities(full.use)).total;
}

/// Returns the densities of the shape that fills this share of the body, and analyses it. `extended` goes on
/// beyond the body; under an overhang limit it is refined here, else it is already.
template <std::size_t Dim>
DensityGrid PartOptimizer<Dim>::cut(const DensityGrid& extended, int factor, double volume,
                                    StructureReport& report) const {
    DensityGrid grid =
        recipe_.optimize->overhang ? with_limited_overhang(extended, volume, factor) : extended;
    report.stray_pieces = cut_shape(grid, {volume, volume}, of_parts(problem_->anchored, factor),
                                    of_parts(problem_->loaded, factor));
    // A cut element counts by its solid share.
    analyse(*problem_, domain_, make_penalty_law({1, void_modulus_of<Dim>, 0}),
            coarsened(solid_shares(grid, 0.5), domain_.size, factor), false, nullptr, report);
    return grid;
}

/// Cuts the shape from the densities: it fills as much as they do. With a bounded compliance, the shape,
/// which has no grey, may be lighter; but least sizes hold at the volume of the densities alone.
template <std::size_t Dim>
void PartOptimizer<Dim>::cut_to_bound(DensityGrid found, PartDesign& design) const {
    const StructureReport before = *design.report;
    const OptimizeRecipe& optimize = *recipe_.optimize;
    const double least = share_of(ElementUse::solid), most = problem_->topology.volume;
    double volume = std::min(before.history.back().volume, most);
    const bool has_least_sizes = optimize.member > 0 || optimize.gap > 0;
    const bool seeks_bound = before.compliance_bound > 0 && !has_least_sizes;
    const int rounds = seeks_bound ? 8 : 1;
    constexpr double enough = 0.003;
    const int factor = refinement(domain_.size, optimize.overhang);
    extend_outside(found, extended_layers);
    if (!optimize.overhang) found = refined(found, factor, Interpolation::cubic);
    double nearest = infinity;
    for (int round = 0; round < rounds && nearest > enough; ++round) {
        StructureReport report = before;
        DensityGrid grid = cut(found, factor, volume, report);
        const double ratio =
            seeks_bound ? report.compliance / (before.compliance_bound * report.full_compliance) : 1;
        if (const double miss = std::abs(std::log(ratio)); miss < nearest) {
            nearest = miss;
            *design.report = std::move(report);
            design.grid = std::move(grid);
        }
        volume = std::clamp(volume * std::sqrt(ratio), least, most);
    }
}

template <std::size_t Dim>
PartDesign PartOptimizer<Dim>::optimize() {
    PartDesign design;
    design.box = domain_.box;
    design.report = std::make_shared<StructureReport>();
    StructureReport& report = *design.report;
    describe(*problem_, domain_, report);
    TopologySettings settings = topology_settings(*recipe_.optimize, domain_, options_.cancel);
    settings.shared = options_.shared;
    if (settings.density.length_scale)
        settings.density.open = far_from_holds(settings.density.length_scale->radius);
    if (recipe_.optimize->kind == OptimizeKind::lightness) {
        report.compliance_bound = recipe_.optimize->compliance;
        settings.compliance = report.compliance_bound * full_compliance();
        report.full_compliance = problem_->displacement_unit * settings.compliance / report.compliance_bound;
    }
    TopologyOptimizer<Dim> optimizer(problem_->topology, settings);
    search(optimizer, settings.iterations, report);
    design.grid = densities(optimizer.densities());
    if (foam_) {
        extend_outside(design.grid, extended_layers);
        analyse(*problem_, domain_, problem_->topology.law, design.grid.density, true, nullptr, report);
    } else {
        cut_to_bound(std::move(design.grid), design);
    }
    if (optimizer.is_finished() && options_.cancel != nullptr && options_.cancel->cancelled())
        keep_search(file_, optimizer.state(), *design.report);
    constexpr double bound_is_kept = 1.01;
    if (report.compliance_bound > 0 &&
        report.compliance > bound_is_kept * report.compliance_bound * report.full_compliance)
        report.notes.emplace_back(
            "the compliance is above its bound: more volume or iterations, or a larger part may meet it");
    return design;
}

}  // namespace

PartDesign stiffest_part(const Recipe& recipe, const Field& body, const BuiltRegions& regions,
                         Gradings& gradings, const OptimizeOptions& options,
                         const std::filesystem::path& search) {
    ElementDomain domain = element_domain(recipe, body, regions, options.cancel);
    if (domain.dimensions == 2)
        return PartOptimizer<2>(recipe, body, std::move(domain), gradings, options, search).optimize();
    return PartOptimizer<3>(recipe, body, std::move(domain), gradings, options, search).optimize();
}

}  // namespace lamella
