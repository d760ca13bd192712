// Plans of elements, kept under the identity of their problem, and the solids that they describe.
#include "recipe/structure/place_elements.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/base/parallel.h"
#include "engine/solids/csg.h"
#include "recipe/build/kept_plan.h"
#include "recipe/identity.h"
#include "recipe/placement/part_placement.h"
#include "recipe/structure/build_elements.h"
#include "recipe/structure/element_solid.h"
#include "recipe/structure/load_bearing_elements.h"
#include "recipe/structure/spread_elements.h"

namespace lamella {

namespace {

/// Returns the recipe without what does not decide where elements are.
Recipe elements_problem(const Recipe& recipe) {
    Recipe kept;
    kept.part = has_skin_of_elements(recipe) ? recipe.part : not_turned(recipe.part);
    kept.fields = recipe.fields;
    kept.gradings = recipe.gradings;
    const bool is_on_skin = has_skin_of_elements(recipe);
    for (const RegionRecipe& region : recipe.regions) {
        const bool is_passive = region.make == RegionMake::solid || region.make == RegionMake::empty;
        if (is_on_skin || is_passive) kept.regions.push_back(region);
    }
    kept.material = recipe.material;
    kept.loads = recipe.loads;
    kept.anchors = recipe.anchors;
    kept.element_shapes = recipe.element_shapes;
    kept.elements = recipe.elements;
    if (is_on_skin) {
        kept.skin = recipe.skin;
        kept.optimize = recipe.optimize;  // the body may be the shape that is found
        kept.foam = recipe.foam;
        kept.frame = recipe.frame;
    }
    return kept;
}

/// Returns the plan of a problem: the one that is kept, or one that is made.
template <typename Make>
ElementPlan plan_of(const Recipe& problem, const PlaceElementsOptions& options, const Make& make) {
    std::filesystem::path file;
    if (!options.plans.empty()) {
        file = options.plans / (job_identity(problem) + ".elements");
        if (auto kept = read_kept(file, read_element_plan)) return std::move(*kept);
    }
    if (options.on_iteration) options.on_iteration({}, problem.elements->iterations);
    ThreadArena arena(options.threads);
    ElementPlan plan = arena.execute(make);
    if (!file.empty())
        keep_if_possible(file, [&](const std::filesystem::path& to) { write_element_plan(to, plan); });
    return plan;
}

/// Returns the edge of cells of which each element has about a hundred, mm.
double spread_edge(const Recipe& recipe, const Box& bounds) {
    constexpr double cells_an_element = 100;
    const dvec3 size = bounds.size();
    const double cells = cells_an_element * recipe.elements->count;
    return recipe.elements->dimensions == 2 ? std::sqrt(size.x * size.y / cells)
                                            : std::cbrt(size.x * size.y * size.z / cells);
}

}  // namespace

bool has_skin_of_elements(const Recipe& recipe) {
    return recipe.elements && recipe.skin && recipe.skin->pattern == "elements";
}

PlacedElements place_elements(const Recipe& recipe, const FieldPtr& body, const BuiltRegions& regions,
                              Gradings& gradings, const PlaceElementsOptions& options) {
    const Recipe problem = elements_problem(recipe);
    const bool is_flat = problem.elements->dimensions == 2;
    // Outlines of a plate are so thick that it makes no difference.
    std::optional<double> thickness;
    if (is_flat) thickness = 2 * length(body->bounds().size());
    const std::vector<ElementShapePtr> shapes = build_elements(problem, thickness, gradings);
    ElementPlan plan = plan_of(problem, options, [&] {
        const bool is_loaded = !problem.loads.empty();
        const double least_edge = is_loaded ? 0 : spread_edge(problem, body->bounds());
        ElementGrid grid = element_grid(problem, *body, regions, shapes, least_edge, options.cancel);
        return is_loaded ? load_bearing_elements(problem, *body, regions, std::move(grid), shapes, gradings,
                                                 options)
                         : spread_in_body(problem, *body, grid, shapes, gradings, options);
    });
    std::optional<Interval> upright;
    if (is_flat) upright = Interval{body->bounds().lo.z, body->bounds().hi.z};
    std::vector<FieldPtr> solids{element_solid(shapes, plan, recipe.elements->bridge, upright)};
    for (const BuiltRegion& region : regions.list) {
        if (region.make == RegionMake::solid) solids.push_back(region.field);
    }
    return {std::move(plan), make_intersection({body, make_union(std::move(solids))})};
}

PlacedElements place_elements_on_skin(const Recipe& recipe, const FieldPtr& body, const FieldPtr& shell,
                                      double depth, Gradings& gradings, const PlaceElementsOptions& options) {
    const Recipe problem = elements_problem(recipe);
    const FieldPtr inner = make_intersection({body, shell});  // shells lie on both sides
    ElementPlan plan = plan_of(
        problem, options, [&] { return spread_on_skin(problem, *body, *inner, depth, gradings, options); });
    std::uint32_t last = 0;
    for (const PlacedElement& element : plan.elements) last = std::max(last, element.shape);
    const std::size_t steps = 1 + last / problem.element_shapes.size();
    const std::vector<ElementShapePtr> shapes = skin_shapes(problem, plan.thickness, steps, gradings);
    FieldPtr elements = element_solid(shapes, plan, recipe.elements->bridge, std::nullopt, body.get());
    return {std::move(plan), make_intersection({inner, std::move(elements)})};
}

}  // namespace lamella
