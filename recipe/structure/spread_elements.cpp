// Sites with densities and ways, elements spread over them, and made one piece.
#include "recipe/structure/spread_elements.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/base/whole_file.h"
#include "procedural/elements/element_arrangement.h"
#include "procedural/elements/element_spread.h"
#include "procedural/skin/surface_walk.h"
#include "procedural/texture/body_sites.h"
#include "recipe/structure/build_elements.h"
#include "recipe/structure/element_ways.h"

namespace lamella {

namespace {

constexpr Interval density_limits{0, 1e6};

/// Sets the densities of sites, and the ways of those in a body.
void set_wishes(const Recipe& recipe, Gradings& gradings, const std::optional<ElementWays>& ways,
                SpreadSites& sites) {
    const GradingPtr density =
        graded("elements.density", recipe.elements->density, density_limits, gradings).made;
    sites.densities.resize(sites.size());
    density->numbers(sites.places, sites.densities);
    for (double& d : sites.densities) d = std::isfinite(d) ? std::max(d, 0.0) : 0;
    if (!ways || !sites.normals.empty()) return;
    for (const dvec3 p : sites.places) sites.ways.push_back(ways->at(p));
}

/// Reads the example after which elements are spread; empty if there is none.
std::vector<PlacedElement> example_of(const Recipe& recipe) {
    const ElementsRecipe& elements = *recipe.elements;
    if (elements.example.empty()) return {};
    return read_arrangement(whole_file(elements.example, "a list of copies"), elements.example,
                            {.shapes = static_cast<std::uint32_t>(recipe.element_shapes.size()),
                             .scales = {elements.scale_min, elements.scale_max}});
}

/// Spreads the recipe's elements over the sites.
std::vector<PlacedElement> spread(const Recipe& recipe, const SpreadSites& sites,
                                  std::span<const ElementShapePtr> shapes, bool is_aligned,
                                  const CancelToken* cancel) {
    const ElementsRecipe& elements = *recipe.elements;
    const std::vector<PlacedElement> example = example_of(recipe);
    return spread_elements(sites, shapes,
                           {.count = static_cast<std::size_t>(elements.count),
                            .scale = {elements.scale_min, elements.scale_max},
                            .is_aligned = is_aligned,
                            .turns = elements.turns,
                            .rounds = elements.iterations,
                            .example = example,
                            .variation = example.empty() ? 0 : spacing_variation(example),
                            .seed = static_cast<std::uint64_t>(elements.seed),
                            .cancel = cancel});
}

/// Throws InputError for elements that overlap more than the recipe allows.
void check_overlap(const ElementsRecipe& recipe, const SpreadCover& cover) {
    if (cover.overlap <= recipe.overlap) return;
    throw InputError(fmt::format(
        "elements.overlap / --elements-overlap: {:.3g} of the elements lies in others, more than {}; "
        "accepted: {:.2g}, or fewer or smaller elements",
        cover.overlap, recipe.overlap, std::ceil(100 * cover.overlap) / 100));
}

/// Joins spread elements, and stores what they cover. Throws InputError where they are not as they should be.
ElementPlan one_piece(const ElementsRecipe& recipe, const SpreadSites& sites,
                      std::vector<PlacedElement> elements, std::span<const ElementShapePtr> shapes,
                      const JoinSettings& settings) {
    check_overlap(recipe, cover_of(sites, elements, shapes));
    const std::vector<double> alike(elements.size(), 1.0);
    JoinedElements joined = joined_elements(std::move(elements), alike, shapes, settings);
    if (joined.dropped > joined.elements.size())
        throw InputError(fmt::format(
            "elements: {} of {} elements touch no others within elements.reach, {:.3g} mm; accepted: more or "
            "larger elements, or a longer reach",
            joined.dropped, recipe.count, settings.reach));
    const SpreadCover cover = cover_of(sites, joined.elements, shapes);
    check_overlap(recipe, cover);
    return {.elements = std::move(joined.elements),
            .bridges = std::move(joined.bridges),
            .pieces = joined.pieces,
            .moved = joined.moved,
            .dropped = joined.dropped,
            .volume = cover.share,
            .overlap = cover.overlap};
}

/// Sets the tangents of sites along the ways, as far as the surface lets them, or smooth by themselves.
std::vector<dvec3> tangents_of(SurfaceSites& surface, const std::optional<ElementWays>& ways) {
    constexpr int sweeps = 50;
    set_tangents(surface, nullptr, std::nullopt, sweeps);
    if (!ways) return surface.tangents;
    for (std::size_t i = 0; i < surface.size(); ++i) {
        const dvec3 n = surface.normals[i], way = ways->at(surface.places[i]);
        const dvec3 flat = way - n * glm::dot(n, way);
        constexpr double least = 1e-3;
        if (length(flat) > least) surface.tangents[i] = flat / length(flat);
    }
    return surface.tangents;
}

constexpr double same_side = 0.3;  // least cosine of the angle between normals

/// Returns how far the surface departs from the tangent plane of an element, within its outline, mm at scale
/// 1.
double sagitta(const SpreadSites& sites, const PlacedElement& element, const ElementShape& shape) {
    const dvec3 up = element.turn * dvec3(0, 0, 1);
    const Box box = shape.bounds();
    const double reach = std::max(box.size().x, box.size().y);
    double greatest = 0;
    for (std::size_t i = 0; i < sites.size(); ++i) {
        if (glm::dot(sites.normals[i], up) < same_side) continue;
        const dvec3 p = element.local(sites.places[i]);
        const bool is_near = std::abs(p.z) < reach && box.contains({p.x, p.y, box.center().z});
        if (is_near && shape.distance({p.x, p.y, 0}) < 0) greatest = std::max(greatest, std::abs(p.z));
    }
    return greatest;
}

/// Makes each outline as thick as it has to be to reach through the skin: its shape becomes one of
/// skin_shapes(). Returns the number of thicknesses.
std::size_t set_thicknesses(const SpreadSites& sites, std::span<const ElementShapePtr> flat, double depth,
                            double thinnest, std::vector<PlacedElement>& elements) {
    std::vector<std::uint32_t> steps(elements.size());
    parallel_for(elements.size(), [&](std::size_t k) {
        const PlacedElement& element = elements[k];
        const double thickness = 2 * (depth / element.scale + sagitta(sites, element, *flat[element.shape]));
        steps[k] = static_cast<std::uint32_t>(
            std::ceil(std::max(std::log(thickness / thinnest) / std::log(skin_step), 0.0)));
    });
    for (std::size_t k = 0; k < elements.size(); ++k)
        elements[k].shape += steps[k] * static_cast<std::uint32_t>(flat.size());
    return 1 + std::ranges::max(steps);
}

}  // namespace

ElementPlan spread_in_body(const Recipe& recipe, const Field& body, const ElementGrid& grid,
                           const std::vector<ElementShapePtr>& shapes, Gradings& gradings,
                           const PlaceElementsOptions& options) {
    const ElementDomain& domain = grid.domain;
    SpreadSites sites{.spacing = grid.cells.edge(), .is_flat = grid.is_flat()};
    for (int z = 0; z < domain.size.z; ++z) {
        for (int y = 0; y < domain.size.y; ++y) {
            for (int x = 0; x < domain.size.x; ++x) {
                if (domain.use[grid.cells.number({x, y, z})] == ElementUse::free)
                    sites.places.push_back(grid.cells.centre({x, y, z}));
            }
        }
    }
    sites.sizes.assign(sites.size(), 1.0);
    const std::optional<ElementWays> ways = element_ways(recipe, gradings);
    set_wishes(recipe, gradings, ways, sites);
    std::vector<PlacedElement> elements = spread(recipe, sites, shapes, ways.has_value(), options.cancel);
    const JoinSettings settings = join_settings(*recipe.elements, grid, body, elements);
    return one_piece(*recipe.elements, sites, std::move(elements), shapes, settings);
}

ElementPlan spread_on_skin(const Recipe& recipe, const Field& body, const Field& shell, double depth,
                           Gradings& gradings, const PlaceElementsOptions& options) {
    const ElementsRecipe& wanted = *recipe.elements;
    const std::vector<ElementShapePtr> flat = build_elements(recipe, 2 * depth, gradings);
    const std::vector<DistanceTable> tables = element_tables(flat, 0, true);
    check_element_sizes(recipe, tables, body.bounds());
    const double thinnest = thinnest_of(wanted, tables);
    constexpr double sites_a_thickness = 5;
    const double spacing = wanted.element > 0 ? wanted.element : thinnest / sites_a_thickness;
    constexpr std::size_t most_sites = 4'000'000;
    SurfaceSites surface = sites_on_surface(body, spacing, most_sites, options.cancel);
    const std::optional<ElementWays> ways = element_ways(recipe, gradings);
    SpreadSites sites{.spacing = spacing, .places = surface.places, .normals = surface.normals};
    sites.ways = tangents_of(surface, ways);
    // So many cubes of the sites' lattice have their foot within themselves.
    for (const dvec3 n : sites.normals)
        sites.sizes.push_back(std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)}));
    set_wishes(recipe, gradings, ways, sites);
    const bool is_aligned = ways.has_value() || !wanted.turns;
    std::vector<PlacedElement> elements = spread(recipe, sites, flat, is_aligned, options.cancel);
    const double thickness = 2 * depth / wanted.scale_max;
    const std::size_t steps = set_thicknesses(sites, flat, depth, thickness, elements);
    const std::vector<ElementShapePtr> shapes = skin_shapes(recipe, thickness, steps, gradings);
    constexpr double held_share = 0.08;  // of the thinnest shape or of the skin
    JoinSettings settings{.hold = held_share * std::min(thinnest, depth),
                          .reach = wanted.reach > 0 ? wanted.reach : thinnest,
                          .bridge = wanted.bridge};
    settings.body = &shell;
    settings.settle = [&](PlacedElement& element) {
        const auto foot = foot_on_surface(body, element.at, 1e-3 * spacing);
        if (!foot) return;
        element.at = foot->place;
        element.turn =
            glm::normalize(shortest_turn(element.turn * dvec3(0, 0, 1), foot->normal) * element.turn);
    };
    // Round an edge, but not on the other side of a thin wall, which prisms may reach.
    settings.may_hold = [&](const PlacedElement& a, const PlacedElement& b, dvec3 at) {
        constexpr double round_edge = -0.2;  // least cosine of the angle between normals
        const auto foot = foot_on_surface(body, at, 1e-3 * spacing);
        const dvec3 up(0, 0, 1), up_a = a.turn * up, up_b = b.turn * up;
        return foot && std::min({glm::dot(up_a, up_b), glm::dot(up_a, foot->normal),
                                 glm::dot(up_b, foot->normal)}) >= round_edge;
    };
    ElementPlan plan = one_piece(wanted, sites, std::move(elements), shapes, settings);
    plan.thickness = thickness;
    return plan;
}

}  // namespace lamella
