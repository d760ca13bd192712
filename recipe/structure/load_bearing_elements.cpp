// The optimum that tells where elements begin, their search, and the analysis of what they become.
#include "recipe/structure/load_bearing_elements.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "procedural/elements/element_search.h"
#include "procedural/elements/element_start.h"
#include "procedural/optimization/element_stress.h"
#include "procedural/optimization/topology_optimizer.h"
#include "recipe/structure/design_settings.h"
#include "recipe/structure/element_solid.h"
#include "recipe/structure/element_ways.h"
#include "recipe/structure/structural_problem.h"
#include "recipe/structure/structure_report.h"

namespace lamella {

namespace {

constexpr double unfilled_modulus = 1e-6;  // loads that no element bears must not make equations hopeless

/// The part's cells, and the problem that its loads pose on them.
template <std::size_t Dim>
struct LoadedGrid {
    ElementGrid grid;
    StructuralProblem<Dim> problem;

    LoadedGrid(const Recipe& recipe, Gradings& gradings, ElementGrid of, const FilledElements& filled = {})
        : grid(std::move(of)),
          problem(structural_problem<Dim>(recipe, grid.domain, gradings, material_poisson, filled)) {
        problem.topology.law = make_penalty_law({3, unfilled_modulus, 0});
    }
    ElementSearchGrid<Dim> search_grid() const {
        return {&problem.topology, grid.cells, grid.tables, problem.displacement_unit};
    }
};

/// Returns the elements that are at least half full.
FilledElements filled(std::span<const double> shares) {
    constexpr double half = 0.5;
    FilledElements flags;
    flags.reserve(shares.size());
    for (const double share : shares) flags.push_back(share >= half ? 1 : 0);
    return flags;
}

/// One search, in the plane or in space.
template <std::size_t Dim>
class ElementSearch {
  public:
    ElementSearch(const Recipe& recipe, const Field& body, const BuiltRegions& regions, ElementGrid grid,
                  const std::vector<ElementShapePtr>& shapes, Gradings& gradings,
                  const PlaceElementsOptions& options)
        : recipe_(recipe),
          elements_(*recipe.elements),
          body_(body),
          gradings_(gradings),
          options_(options),
          shapes_(shapes),
          coarse_(recipe, gradings, std::move(grid)),
          fine_(finer_element_grid(recipe, body, regions, shapes, coarse_.grid, options.cancel)),
          ways_(element_ways(recipe, gradings)) {}

    ElementPlan run() {
        ElementPlan plan;
        check_volume();
        const FoundElements found = search(start(plan));
        JoinedElements joined =
            joined_elements(found.elements, found.loads, shapes_,
                            join_settings(elements_, coarse_.grid, body_, found.elements));
        plan.elements = std::move(joined.elements);
        plan.bridges = std::move(joined.bridges);
        plan.pieces = joined.pieces;
        plan.moved = joined.moved;
        plan.dropped = joined.dropped;
        judge(plan);
        return plan;
    }

  private:
    double cell_volume() const { return Dim == 2 ? grid_.edges.x * grid_.edges.y : domain_.element_volume(); }
    double middle_scale() const { return 0.5 * (elements_.scale_min + elements_.scale_max); }
    double volume() const;
    double solid_volume() const {
        return static_cast<double>(std::ranges::count(domain_.use, ElementUse::solid)) /
               static_cast<double>(domain_.elements());
    }
    void check_volume() const;
    ElementSettings settings() const;
    std::vector<PlacedElement> start(ElementPlan& plan);
    FoundElements search(std::vector<PlacedElement> start) const;
    std::vector<double> free_densities(const TopologyOptimizer<Dim>& optimum) const;
    std::vector<dvec3> stress_ways(const TopologyOptimizer<Dim>& optimum) const;
    std::vector<double> shares_of(const Field& solid, const ElementGrid& grid) const;
    void judge(ElementPlan& plan) const;

    const Recipe& recipe_;
    const ElementsRecipe& elements_;
    const Field& body_;
    Gradings& gradings_;
    const PlaceElementsOptions& options_;
    const std::vector<ElementShapePtr>& shapes_;
    LoadedGrid<Dim> coarse_;
    std::optional<ElementGrid> fine_;  ///< none where there would be too many cells
    std::optional<ElementWays> ways_;
    const ElementDomain& domain_ = coarse_.grid.domain;
    const CellGrid& grid_ = coarse_.grid.cells;
    std::span<const DistanceTable> tables_ = coarse_.grid.tables;
    StructuralProblem<Dim>& problem_ = coarse_.problem;
};

/// Returns the content of all elements, as a share of the body's.
template <std::size_t Dim>
double ElementSearch<Dim>::volume() const {
    double mean = 0;
    for (const DistanceTable& table : tables_) mean += table.content() / static_cast<double>(tables_.size());
    const double scale = middle_scale();
    const double all = elements_.count * mean * (Dim == 2 ? scale * scale : scale * scale * scale);
    return all / (cell_volume() * static_cast<double>(domain_.elements()));
}

template <std::size_t Dim>
void ElementSearch<Dim>::check_volume() const {
    constexpr double least = 0.005;
    const double most = 0.95 - solid_volume(), share = volume();
    if (share > least && share < most) return;
    throw InputError(fmt::format(
        "elements.count / --elements-count: {} elements of these shapes have {:.3g} times the part's volume; "
        "accepted: {} to {}, or {} shapes",
        elements_.count, share, std::ceil(least / share * elements_.count),
        std::floor(std::max(most, 0.0) / share * elements_.count), share < most ? "larger" : "smaller"));
}

template <std::size_t Dim>
ElementSettings ElementSearch<Dim>::settings() const {
    return {.overlap = elements_.overlap,
            .turns = elements_.turns && !ways_,
            .scale = {elements_.scale_min, elements_.scale_max},
            .iterations = elements_.iterations,
            .seed = static_cast<std::uint64_t>(elements_.seed),
            .way = ways_ ? std::function([this](dvec3 p) { return ways_->at(p); }) : nullptr,
            .cancel = options_.cancel};
}

/// Returns the densities of the cells that elements may fill.
template <std::size_t Dim>
std::vector<double> ElementSearch<Dim>::free_densities(const TopologyOptimizer<Dim>& optimum) const {
    const std::span<const double> found = optimum.densities().density(DensityMap::Role::result);
    std::vector<double> densities(found.size(), 0.0);
    for (std::size_t i = 0; i < densities.size(); ++i) {
        if (problem_.topology.use[i] == ElementUse::free) densities[i] = found[i];
    }
    return densities;
}

/// Returns the direction of the greatest principal stress of all cases, by cell.
template <std::size_t Dim>
std::vector<dvec3> ElementSearch<Dim>::stress_ways(const TopologyOptimizer<Dim>& optimum) const {
    const TopologyProblem<Dim>& topology = problem_.topology;
    std::vector<dvec3> ways(topology.use.size(), dvec3(1, 0, 0));
    std::vector<double> strongest(ways.size(), 0.0);
    const std::vector<std::size_t> numbers = element_numbers(topology.body.grid);
    for (std::size_t c = 0; c < topology.cases.size(); ++c) {
        const auto stresses = greatest_principal_stresses(topology.body, problem_.material.elastic.poisson,
                                                          optimum.compliance().displacements(c));
        for (std::size_t i = 0; i < ways.size(); ++i) {
            const PrincipalStress& stress = stresses[numbers[i]];
            const double weighted = std::abs(stress.stress) * topology.cases[c].weight;
            if (!(weighted > strongest[i])) continue;
            strongest[i] = weighted;
            ways[i] = stress.way;
        }
    }
    return ways;
}

/// Samples elements by the densities of least compliance at their volume, turned along the principal stress.
template <std::size_t Dim>
std::vector<PlacedElement> ElementSearch<Dim>::start(ElementPlan& plan) {
    TopologyProblem<Dim>& topology = problem_.topology;
    topology.volume = volume() + solid_volume();
    TopologySettings settings;
    settings.density.radius = 1.5;
    settings.iterations = 60;
    settings.sharpness = 16;
    settings.cancel = options_.cancel;
    TopologyOptimizer<Dim> optimum(topology, settings);
    while (!optimum.is_finished()) optimum.iterate();
    plan.optimum = optimum.analyse().total * problem_.displacement_unit;
    optimum.show_design();
    return sampled_elements(grid_, free_densities(optimum), stress_ways(optimum),
                            {.count = static_cast<std::size_t>(elements_.count),
                             .scale = {elements_.scale_min, elements_.scale_max},
                             .shapes = static_cast<std::uint32_t>(shapes_.size()),
                             .turns = elements_.turns,
                             .seed = static_cast<std::uint64_t>(elements_.seed)});
}

/// Searches on the coarse grid, and then on the fine one, where loads act on what the elements cover by then.
template <std::size_t Dim>
FoundElements ElementSearch<Dim>::search(std::vector<PlacedElement> start) const {
    const auto on_iteration = [&](const ElementIteration& done) {
        if (options_.on_iteration) options_.on_iteration(done, elements_.iterations);
    };
    ElementSettings wanted = settings();
    const int all = wanted.iterations, end = fine_ ? coarse_iterations(all) : all;
    FoundElements found = search_elements(coarse_.search_grid(), wanted, end, std::move(start), on_iteration);
    if (!fine_) return found;
    ElementRaster covered(fine_->cells, fine_->domain.use, fine_->tables, fine_->cells.edge(), 0);
    covered.set(found.elements);
    const LoadedGrid<Dim> fine(recipe_, gradings_, *fine_, filled(covered.densities()));
    wanted.begin = end;
    return search_elements(fine.search_grid(), wanted, all, std::move(found.elements), on_iteration);
}

/// Returns the share of each cell that a solid fills.
template <std::size_t Dim>
std::vector<double> ElementSearch<Dim>::shares_of(const Field& solid, const ElementGrid& grid) const {
    constexpr int parts = 4;
    constexpr int along_z = Dim == 2 ? 1 : parts;
    const CellGrid& cells = grid.cells;
    std::vector<double> shares = full_densities(grid.domain.use);
    parallel_for(shares.size(), [&](std::size_t i) {
        if (grid.domain.use[i] != ElementUse::free) return;
        const auto x = static_cast<int>(i) % cells.size.x,
                   y = static_cast<int>(i) / cells.size.x % cells.size.y,
                   z = static_cast<int>(i) / cells.size.x / cells.size.y;
        int inside = 0;
        for (int k = 0; k < parts * parts * along_z; ++k) {
            const glm::ivec3 part(k % parts, k / parts % parts, k / (parts * parts));
            const dvec3 share = (dvec3(part) + 0.5) / dvec3(parts, parts, along_z);
            if (solid.value(cells.corner + (dvec3(x, y, z) + share) * cells.edges) < 0) ++inside;
        }
        shares[i] = inside / static_cast<double>(parts * parts * along_z);
    });
    return shares;
}

/// Analyses the true shapes on the finest grid. The optimum, which the coarse one knows, is told as if the
/// whole body were as stiff on both.
template <std::size_t Dim>
void ElementSearch<Dim>::judge(ElementPlan& plan) const {
    std::optional<Interval> upright;
    if (Dim == 2) upright = Interval{domain_.box.lo.z, domain_.box.hi.z};
    const FieldPtr solid = element_solid(shapes_, plan, elements_.bridge, upright);
    const ElementGrid& finest = fine_ ? *fine_ : coarse_.grid;
    const std::vector<double> shares = shares_of(*solid, finest);
    const LoadedGrid<Dim> loaded(recipe_, gradings_, finest, filled(shares));
    StructureReport report;
    describe(loaded.problem, loaded.grid.domain, report);
    analyse(loaded.problem, loaded.grid.domain, make_penalty_law({1, void_modulus_of<Dim>, 0}), shares, false,
            options_.cancel, report);
    if (fine_) {
        Compliance<Dim> coarse(problem_.topology, {.tolerance = 1e-6, .cancel = options_.cancel});
        const double full = coarse.evaluate(full_densities(domain_.use)).total * problem_.displacement_unit;
        plan.optimum *= report.full_compliance / full;
    }
    plan.volume = report.volume;
    plan.compliance = report.compliance;
    plan.full_compliance = report.full_compliance;
    constexpr double unheld = 1e4;
    if (plan.compliance > unheld * plan.full_compliance)
        throw InputError(fmt::format(
            "elements: those that are left ({}) do not reach all loads and anchors; accepted: a solid "
            "[[region]] where these act on much of the part, more or longer elements, or more iterations",
            plan.elements.size()));
}

}  // namespace

ElementPlan load_bearing_elements(const Recipe& recipe, const Field& body, const BuiltRegions& regions,
                                  ElementGrid grid, const std::vector<ElementShapePtr>& shapes,
                                  Gradings& gradings, const PlaceElementsOptions& options) {
    if (grid.is_flat())
        return ElementSearch<2>(recipe, body, regions, std::move(grid), shapes, gradings, options).run();
    return ElementSearch<3>(recipe, body, regions, std::move(grid), shapes, gradings, options).run();
}

}  // namespace lamella
