// Shapes, the optimum that tells where elements begin, their search, and the analysis of what they become.
#include "recipe/structure/place_elements.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/solids/csg.h"
#include "procedural/elements/element_field.h"
#include "procedural/elements/element_pieces.h"
#include "procedural/elements/element_start.h"
#include "procedural/optimization/density_shape.h"
#include "procedural/optimization/element_stress.h"
#include "procedural/optimization/topology_optimizer.h"
#include "recipe/build/kept_plan.h"
#include "recipe/identity.h"
#include "recipe/structure/build_elements.h"
#include "recipe/structure/design_settings.h"
#include "recipe/structure/structural_problem.h"
#include "recipe/structure/structure_report.h"

namespace lamella {

namespace {

constexpr double cells_a_thickness = 3.2;  // of the thinnest shape: fewer, and elements look like void
constexpr double least_cells = 2;
constexpr double unfilled_modulus = 1e-6;  // loads that no element bears must not make equations hopeless
constexpr int table_samples_2d = 128, table_samples_3d = 48;

/// Returns the recipe of the search: without what does not decide it.
Recipe elements_problem(const Recipe& recipe) {
    Recipe kept;
    kept.part = recipe.part;
    kept.fields = recipe.fields;
    kept.gradings = recipe.gradings;
    for (const RegionRecipe& region : recipe.regions) {
        if (region.make == RegionMake::solid || region.make == RegionMake::empty)
            kept.regions.push_back(region);
    }
    kept.material = recipe.material;
    kept.loads = recipe.loads;
    kept.anchors = recipe.anchors;
    kept.element_shapes = recipe.element_shapes;
    kept.elements = recipe.elements;
    return kept;
}

/// Returns the thickness of the thinnest copy, mm.
double thinnest_of(const ElementsRecipe& elements, std::span<const DistanceTable> tables) {
    double thinnest = infinity;
    for (const DistanceTable& table : tables) thinnest = std::min(thinnest, table.thickness());
    return thinnest * elements.scale_min;
}

/// One search, in the plane or in space.
template <std::size_t Dim>
class ElementSearch {
  public:
    ElementSearch(const Recipe& recipe, const Field& body, ElementDomain domain,
                  const std::vector<ElementShapePtr>& shapes, std::vector<DistanceTable> tables,
                  Gradings& gradings, const PlaceElementsOptions& options)
        : elements_(*recipe.elements),
          body_(body),
          options_(options),
          domain_(std::move(domain)),
          shapes_(shapes),
          tables_(std::move(tables)),
          problem_(structural_problem<Dim>(recipe, domain_, gradings, material_poisson)),
          grid_{domain_.size, domain_.box.lo, domain_.edges, Dim == 2} {
        problem_.topology.law = make_penalty_law({3, unfilled_modulus, 0});
    }

    ElementPlan run() {
        ElementPlan plan;
        check_volume();
        ElementOptimizer<Dim> search(problem_.topology, grid_, tables_, settings(), start(plan));
        while (!search.is_finished()) {
            ElementIteration done = search.iterate();
            done.compliance *= problem_.displacement_unit;
            if (options_.on_iteration) options_.on_iteration(done, elements_.iterations);
        }
        JoinedElements joined =
            join_elements(search.elements(), search.loads(), shapes_, join_settings(search));
        plan.elements = std::move(joined.elements);
        plan.pieces = joined.pieces;
        plan.moved = joined.moved;
        plan.dropped = joined.dropped;
        if (joined.apart > 0)
            throw InputError(
                fmt::format("elements: {} pieces of solid regions stand apart from the others; accepted: "
                            "regions that elements "
                            "reach, more elements, or a region that joins them",
                            joined.apart));
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
    JoinSettings join_settings(const ElementOptimizer<Dim>& search) const;
    void judge(ElementPlan& plan) const;

    const ElementsRecipe& elements_;
    const Field& body_;
    const PlaceElementsOptions& options_;
    ElementDomain domain_;
    const std::vector<ElementShapePtr>& shapes_;
    std::vector<DistanceTable> tables_;
    StructuralProblem<Dim> problem_;
    CellGrid grid_;
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
            .turns = elements_.turns,
            .scale = {elements_.scale_min, elements_.scale_max},
            .iterations = elements_.iterations,
            .seed = static_cast<std::uint64_t>(elements_.seed),
            .cancel = options_.cancel};
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
    const std::span<const double> found = optimum.densities().density(DensityMap::Role::result);
    std::vector<double> densities(found.begin(), found.end());
    for (std::size_t i = 0; i < densities.size(); ++i) {
        if (topology.use[i] != ElementUse::free) densities[i] = 0;
    }
    std::vector<dvec3> ways(densities.size(), dvec3(1, 0, 0));
    std::vector<double> strongest(densities.size(), 0.0);
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
    return sampled_elements(grid_, densities, ways,
                            {.count = static_cast<std::size_t>(elements_.count),
                             .scale = {elements_.scale_min, elements_.scale_max},
                             .shapes = static_cast<std::uint32_t>(shapes_.size()),
                             .turns = elements_.turns,
                             .seed = static_cast<std::uint64_t>(elements_.seed)});
}

template <std::size_t Dim>
JoinSettings ElementSearch<Dim>::join_settings(const ElementOptimizer<Dim>& search) const {
    const double thinnest = thinnest_of(elements_, tables_);
    constexpr double held_share = 0.08;  // of the thinnest shape
    JoinSettings settings{.hold = held_share * thinnest,
                          .reach = elements_.reach > 0 ? elements_.reach : thinnest,
                          .is_flat = Dim == 2};
    settings.body = &body_;
    const auto is_solid = [&](std::size_t i) { return domain_.use[i] == ElementUse::solid; };
    const std::vector<std::int32_t> solid = pieces_by_faces(grid_.size, is_solid);
    settings.solids = static_cast<std::uint32_t>(std::ranges::max(solid) + 1);
    ElementRaster raster(grid_, domain_.use, tables_, grid_.edge(), 0);
    raster.set(search.elements());
    std::vector<double> mask(solid.size());
    for (std::uint32_t piece = 0; piece < settings.solids; ++piece) {
        std::ranges::transform(solid, mask.begin(), [&](std::int32_t p) {
            return p == static_cast<std::int32_t>(piece) ? 1.0 : 0.0;
        });
        const std::vector<double> shares = raster.shares(mask);
        constexpr double enough = 0.5;  // of a cell's worth of element in solid cells
        for (std::uint32_t k = 0; k < shares.size(); ++k) {
            if (shares[k] > enough) settings.touches.push_back({k, piece});
        }
    }
    return settings;
}

/// Analyses the true shapes, by the share of each cell that they fill.
template <std::size_t Dim>
void ElementSearch<Dim>::judge(ElementPlan& plan) const {
    std::optional<Interval> upright;
    if (Dim == 2) upright = Interval{domain_.box.lo.z, domain_.box.hi.z};
    const FieldPtr field = make_element_field(shapes_, plan.elements, upright);
    constexpr int parts = 4;
    constexpr int along_z = Dim == 2 ? 1 : parts;
    std::vector<double> density = full_densities(domain_.use);
    parallel_for(density.size(), [&](std::size_t i) {
        if (domain_.use[i] != ElementUse::free) return;
        const auto x = static_cast<int>(i) % grid_.size.x,
                   y = static_cast<int>(i) / grid_.size.x % grid_.size.y,
                   z = static_cast<int>(i) / grid_.size.x / grid_.size.y;
        int inside = 0;
        for (int k = 0; k < parts * parts * along_z; ++k) {
            const glm::ivec3 part(k % parts, k / parts % parts, k / (parts * parts));
            const dvec3 share = (dvec3(part) + 0.5) / dvec3(parts, parts, along_z);
            if (field->value(grid_.corner + (dvec3(x, y, z) + share) * grid_.edges) < 0) ++inside;
        }
        density[i] = inside / static_cast<double>(parts * parts * along_z);
    });
    StructureReport report;
    describe(problem_, domain_, report);
    analyse(problem_, domain_, make_penalty_law({1, void_modulus_of<Dim>, 0}), density, false,
            options_.cancel, report);
    plan.volume = report.volume;
    plan.compliance = report.compliance;
    plan.full_compliance = report.full_compliance;
    constexpr double unheld = 1e4;
    if (plan.compliance > unheld * plan.full_compliance)
        throw InputError(fmt::format(
            "elements: the {} elements that are left do not reach all loads and anchors; accepted: a solid "
            "[[region]] where these act on much of the part, more or longer elements, or more iterations",
            plan.elements.size()));
}

/// Returns the edge of the finite elements, mm.
double cell_edge(const ElementsRecipe& elements, std::span<const DistanceTable> tables) {
    const double thinnest = thinnest_of(elements, tables);
    if (elements.element == 0) return thinnest / cells_a_thickness;
    if (least_cells * elements.element > thinnest)
        throw InputError(fmt::format(
            "elements.element / --elements-element: {} mm is too coarse for shapes {:.3g} mm thick, "
            "which would look like void; accepted: at most {:.3g} mm",
            elements.element, thinnest, thinnest / least_cells));
    return elements.element;
}

void check_element_sizes(const Recipe& recipe, std::span<const DistanceTable> tables, const Box& bounds) {
    const dvec3 size = bounds.size();
    const bool is_flat = recipe.elements->dimensions == 2;
    const double longest = is_flat ? std::max(size.x, size.y) : std::max({size.x, size.y, size.z});
    for (std::size_t i = 0; i < tables.size(); ++i) {
        const double across = 2 * tables[i].reach() * recipe.elements->scale_min;
        if (across <= longest) continue;
        throw InputError(
            fmt::format("{}: {:.3g} mm across, it is larger than the part, {:.3g} mm; accepted: smaller "
                        "shapes, or a smaller elements.scale_min",
                        recipe.element_shapes[i].where, across, longest));
    }
}

template <std::size_t Dim>
ElementPlan searched(const Recipe& recipe, const Field& body, const BuiltRegions& regions, Gradings& gradings,
                     const std::vector<ElementShapePtr>& shapes, const PlaceElementsOptions& options) {
    const auto tables_with = [&](double margin) {
        std::vector<DistanceTable> tables;
        tables.reserve(shapes.size());
        for (const ElementShapePtr& shape : shapes)
            tables.emplace_back(*shape, margin, Dim == 2 ? table_samples_2d : table_samples_3d, Dim == 2);
        return tables;
    };
    std::vector<DistanceTable> tables = tables_with(0);
    check_element_sizes(recipe, tables, body.bounds());
    Recipe with_grid = recipe;
    with_grid.optimize.emplace();
    with_grid.optimize->dimensions = recipe.elements->dimensions;
    with_grid.optimize->element = cell_edge(*recipe.elements, tables);
    ElementDomain domain = element_domain(with_grid, body, regions, options.cancel);
    // As far as the smooth border of an element reaches.
    tables = tables_with(2 * domain.longest_edge() / recipe.elements->scale_min);
    return ElementSearch<Dim>(recipe, body, std::move(domain), shapes, std::move(tables), gradings, options)
        .run();
}

}  // namespace

PlacedElements place_elements(const Recipe& recipe, const FieldPtr& body, const BuiltRegions& regions,
                              Gradings& gradings, const PlaceElementsOptions& options) {
    const Recipe problem = elements_problem(recipe);
    const bool is_flat = problem.elements->dimensions == 2;
    const std::vector<ElementShapePtr> shapes = build_elements(problem, body->bounds(), gradings);
    std::filesystem::path file;
    if (!options.plans.empty()) file = options.plans / (job_identity(problem) + ".elements");
    std::optional<ElementPlan> kept;
    if (!file.empty()) kept = read_kept(file, read_element_plan);
    if (!kept) {
        if (options.on_iteration) options.on_iteration({}, problem.elements->iterations);
        ThreadArena arena(options.threads);
        kept = arena.execute([&] {
            return is_flat ? searched<2>(problem, *body, regions, gradings, shapes, options)
                           : searched<3>(problem, *body, regions, gradings, shapes, options);
        });
        if (!file.empty())
            keep_if_possible(file, [&](const std::filesystem::path& to) { write_element_plan(to, *kept); });
    }
    PlacedElements placed{.plan = std::move(*kept), .shape = nullptr};
    std::optional<Interval> upright;
    if (is_flat) upright = Interval{body->bounds().lo.z, body->bounds().hi.z};
    std::vector<FieldPtr> solids{make_element_field(shapes, placed.plan.elements, upright)};
    for (const BuiltRegion& region : regions.list) {
        if (region.make == RegionMake::solid) solids.push_back(region.field);
    }
    placed.shape = make_intersection({body, make_union(std::move(solids))});
    return placed;
}

}  // namespace lamella
