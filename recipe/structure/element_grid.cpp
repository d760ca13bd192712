// Cells as wide as the shapes allow; solid regions as pieces of cells.
#include "recipe/structure/element_grid.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/error.h"
#include "procedural/optimization/density_shape.h"

namespace lamella {

namespace {

constexpr double cells_a_thickness = 3.2;  // of the thinnest shape: fewer, and elements look like void
constexpr double least_cells = 1.9;
constexpr int table_samples_2d = 128, table_samples_3d = 48;
constexpr double most_fine_cells_2d = 5e5, most_fine_cells_3d = 1e5;  // more, and iterations take seconds

/// Returns the edge of the finite elements, mm.
double cell_edge(const ElementsRecipe& elements, std::span<const DistanceTable> tables, double least_edge) {
    const double thinnest = thinnest_of(elements, tables);
    if (elements.element == 0) return std::max(thinnest / cells_a_thickness, least_edge);
    if (least_cells * elements.element > thinnest)
        throw InputError(fmt::format(
            "elements.element / --elements-element: {} mm is too coarse for shapes {:.3g} mm thick, "
            "which would look like void; accepted: at most {:.3g} mm",
            elements.element, thinnest, thinnest / least_cells));
    return elements.element;
}

/// Returns the cells of a domain with tables that reach as far as the smooth border of an element.
ElementGrid grid_of(const Recipe& recipe, std::span<const ElementShapePtr> shapes, ElementDomain domain) {
    const bool is_flat = recipe.elements->dimensions == 2;
    const double margin = 2 * domain.longest_edge() / recipe.elements->scale_min;
    const CellGrid cells{domain.size, domain.box.lo, domain.edges, is_flat};
    return {std::move(domain), cells, element_tables(shapes, margin, is_flat)};
}

}  // namespace

std::vector<DistanceTable> element_tables(std::span<const ElementShapePtr> shapes, double margin,
                                          bool is_flat) {
    std::vector<DistanceTable> tables;
    tables.reserve(shapes.size());
    for (const ElementShapePtr& shape : shapes)
        tables.emplace_back(*shape, margin, is_flat ? table_samples_2d : table_samples_3d, is_flat);
    return tables;
}

double thinnest_of(const ElementsRecipe& elements, std::span<const DistanceTable> tables) {
    double thinnest = infinity;
    for (const DistanceTable& table : tables) thinnest = std::min(thinnest, table.thickness());
    return thinnest * elements.scale_min;
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

ElementGrid element_grid(const Recipe& recipe, const Field& body, const BuiltRegions& regions,
                         std::span<const ElementShapePtr> shapes, double least_edge,
                         const CancelToken* cancel) {
    const bool is_flat = recipe.elements->dimensions == 2;
    const std::vector<DistanceTable> tables = element_tables(shapes, 0, is_flat);
    check_element_sizes(recipe, tables, body.bounds());
    Recipe with_grid = recipe;
    with_grid.optimize.emplace();
    with_grid.optimize->dimensions = recipe.elements->dimensions;
    with_grid.optimize->element = cell_edge(*recipe.elements, tables, least_edge);
    return grid_of(recipe, shapes, element_domain(with_grid, body, regions, cancel));
}

std::optional<ElementGrid> finer_element_grid(const Recipe& recipe, const Field& body,
                                              const BuiltRegions& regions,
                                              std::span<const ElementShapePtr> shapes,
                                              const ElementGrid& grid, const CancelToken* cancel) {
    const glm::ivec3 size = grid.cells.size * (grid.is_flat() ? glm::ivec3(2, 2, 1) : glm::ivec3(2));
    const double most = grid.is_flat() ? most_fine_cells_2d : most_fine_cells_3d;
    if (static_cast<double>(size.x) * size.y * size.z > most) return std::nullopt;
    constexpr double ratio = 0.5;
    return grid_of(recipe, shapes,
                   element_domain_of(recipe, body, regions, grid.domain, size, ratio, cancel));
}

JoinSettings join_settings(const ElementsRecipe& recipe, const ElementGrid& grid, const Field& body,
                           std::span<const PlacedElement> elements) {
    const double thinnest = thinnest_of(recipe, grid.tables);
    constexpr double held_share = 0.08;  // of the thinnest shape
    JoinSettings settings{.hold = held_share * thinnest,
                          .reach = recipe.reach > 0 ? recipe.reach : thinnest,
                          .bridge = recipe.bridge,
                          .is_flat = grid.is_flat()};
    settings.body = &body;
    const auto is_solid = [&](std::size_t i) { return grid.domain.use[i] == ElementUse::solid; };
    const std::vector<std::int32_t> solid = pieces_by_faces(grid.cells.size, is_solid);
    settings.solids = static_cast<std::uint32_t>(std::ranges::max(solid) + 1);
    ElementRaster raster(grid.cells, grid.domain.use, grid.tables, grid.cells.edge(), 0);
    raster.set(elements);
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

JoinedElements joined_elements(std::vector<PlacedElement> elements, std::span<const double> loads,
                               std::span<const ElementShapePtr> shapes, const JoinSettings& settings) {
    JoinedElements joined = join_elements(std::move(elements), loads, shapes, settings);
    if (joined.apart == 0) return joined;
    throw InputError(fmt::format(
        "elements: {} pieces of solid regions stand apart from the others; accepted: regions that "
        "elements reach, more elements, or a region that joins them",
        joined.apart));
}

}  // namespace lamella
