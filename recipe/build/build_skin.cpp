// Windows by pattern, one row each, and holes as cylinders.
#include "recipe/build/build_skin.h"

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/field/turned_grading.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"
#include "procedural/skin/image_windows.h"
#include "procedural/skin/surface_windows.h"
#include "recipe/build/pattern_plan.h"
#include "recipe/structure/place_elements.h"
#include "recipe/structure/structural_problem.h"

namespace lamella {

namespace {

SurfaceWindowSettings window_settings(PatternBuildContext& making) {
    const SkinRecipe& skin = *making.recipe.skin;
    SurfaceWindowSettings settings;
    settings.window = skin.window;
    settings.strut = make_turned_grading(making.gradings.resolve(skin.strut), making.axes);
    const auto strut = settings.strut->constant();
    settings.corner = skin.corner;
    if (skin.corner < 0) settings.corner = strut ? 0.5 * *strut : 0.125 * skin.window;
    settings.depth = making.depth;
    return settings;
}

FieldPtr cut_by(const std::shared_ptr<const SurfaceWindows>& windows, PatternBuildContext& making) {
    making.report.windows = windows->seed_count();
    making.report.closed = windows->closed_count();
    return make_patterned_shell(making.shell, windows);
}

FieldPtr voronoi(PatternBuildContext& making) {
    return cut_by(make_voronoi_windows(*making.body, window_settings(making),
                                       static_cast<std::uint64_t>(making.recipe.skin->seed)),
                  making);
}

FieldPtr hexagons(PatternBuildContext& making) {
    return cut_by(make_hexagon_windows(*making.body, window_settings(making)), making);
}

/// Returns a number that has to be the same everywhere; the InputError for one that is not names it as
/// `what`.
double constant_number(PatternBuildContext& making, const GradedNumber& number, const char* what) {
    const auto constant = making.gradings.resolve(number)->constant();
    if (!constant) throw InputError(fmt::format("{} is the same everywhere; accepted: a number", what));
    return *constant;
}

double constant_strut(PatternBuildContext& making) {
    return constant_number(making, making.recipe.skin->strut, "the strut of a picture");
}

FieldPtr image(PatternBuildContext& making) {
    const SkinRecipe& skin = *making.recipe.skin;
    const double strut = constant_strut(making);
    StrutImage picture(read_picture(skin.image),
                       {constant_number(making, skin.image_size, "the size of a picture that is tiled"),
                        strut, skin.threshold < 0 ? 0.5 : skin.threshold, skin.invert});
    making.report.islands = picture.islands();
    making.report.open_share = picture.open_share();
    return make_patterned_shell(
        making.shell, std::make_shared<ImageWindows>(std::move(picture), *making.body, strut, making.depth));
}

void refuse_turned(const PatternBuildContext& making, const char* what) {
    if (making.axes == glm::dmat3(1)) return;
    throw InputError(
        fmt::format("{} cannot be turned with the part; accepted: no turn, mirror or lay_on, and a "
                    "mesh file that is turned already",
                    what));
}

/// Returns the recipe's loads on elements of the skin.
LoadedSkin loaded_skin(PatternBuildContext& making, const SkinElements& elements,
                       std::span<const float> shares) {
    ElementDomain domain{.dimensions = 3,
                         .size = elements.size(),
                         .edges = dvec3(elements.edge()),
                         .box = elements.box(),
                         .use = {}};
    for (const float share : shares) domain.use.push_back(share > 0 ? ElementUse::free : ElementUse::outside);
    const StructuralProblem<3> problem =
        structural_problem<3>(making.recipe, domain, making.gradings, material_poisson);
    LoadedSkin loaded{problem.topology.body, {}};
    const std::vector<std::size_t> numbers = element_numbers(loaded.body.grid);
    for (std::size_t i = 0; i < numbers.size(); ++i)
        loaded.body.present[numbers[i]] = domain.use[i] == ElementUse::outside ? 0 : 1;
    for (const LoadCase<3>& load : problem.topology.cases) loaded.cases.push_back(load.forces);
    return loaded;
}

/// Sets the width of the picture, the same everywhere or graded.
void set_size(PatternBuildContext& making, ExampleSettings& example) {
    constexpr Interval sizes{0.01, 1e5};
    const GradedUse size = turned(
        graded("skin.image_size", making.recipe.skin->image_size, sizes, making.gradings), making.axes);
    if (const auto constant = size.made->constant()) {
        example.size = *constant;
        return;
    }
    const Interval found = range_in(*making.body, *size.made);
    example.size = found.hi;
    example.least_size = found.lo;
    example.graded_size = size.made;
}

FieldPtr by_example(PatternBuildContext& making) {
    const SkinRecipe& skin = *making.recipe.skin;
    SurfacePatternSettings settings;
    settings.example = {
        .strut = constant_strut(making), .gap = skin.gap, .invert = skin.invert, .reinforce = skin.reinforce};
    set_size(making, settings.example);
    if (!skin.second_image.empty()) {
        const GradedUse weight =
            turned(graded("skin.second_weight", skin.second_weight, {0, 1}, making.gradings), making.axes);
        settings.example.second = {std::make_shared<const Volume>(read_picture(skin.second_image)),
                                   weight.made};
    }
    if (skin.threshold >= 0) settings.example.threshold = skin.threshold;
    settings.example.synthesis.seed = static_cast<std::uint64_t>(skin.seed);
    settings.example.synthesis.cancel = making.work.cancel;
    settings.self_supporting = skin.self_supporting;
    if (skin.direction != dvec3(0)) settings.axis = making.axes * skin.direction;
    settings.depth = making.depth;
    settings.shell = making.shell;
    if (!making.recipe.loads.empty() && !making.recipe.anchors.empty()) {
        refuse_turned(making, "loads on a skin");
        settings.loads = [&making](const SkinElements& elements, std::span<const float> shares) {
            return loaded_skin(making, elements, shares);
        };
    }
    ThreadArena arena(making.work.threads);
    const auto pattern = std::make_shared<const SurfacePattern>(arena.execute([&] {
        return pattern_plan(making.recipe, *making.body, settings, making.work.plans,
                            making.work.on_synthesis);
    }));
    const SurfaceBricks& made = pattern->bricks();
    PatternReport& report = making.report;
    report.open_share = 1 - made.share;
    report.picture_share = 1 - made.wanted_share;
    report.pieces = made.pieces;
    report.joins = made.joins;
    report.bridges = made.bridges;
    report.cut_struts = made.cut_struts;
    report.hanging = made.hanging;
    report.detours = made.detours;
    report.dropped = made.dropped;
    report.softness_before = made.softness_before;
    report.softness = made.softness;
    report.site = made.spacing;
    report.bytes = made.bytes();
    return make_patterned_shell(making.shell, pattern);
}

FieldPtr elements(PatternBuildContext& making) {
    refuse_turned(making, "a skin of elements");
    PlaceElementsOptions options{making.work.plans, making.work.threads, making.work.cancel};
    if (making.work.on_synthesis)
        options.on_iteration = [&](const ElementIteration&, int) { making.work.on_synthesis(); };
    PlacedElements placed = place_elements_on_skin(making.recipe, making.body, making.shell, making.depth,
                                                   making.gradings, options);
    making.report.open_share = 1 - placed.plan.volume;
    making.report.elements = std::move(placed.plan);
    return placed.shape;
}

}  // namespace

std::span<const PatternBuilder> pattern_builders() {
    static const std::vector<PatternBuilder> list{
        {{"closed", {}, {}}, nullptr},
        {{"voronoi", {"window", "strut"}, {"corner", "seed"}}, voronoi},
        {{"hexagons", {"window", "strut"}, {"corner"}}, hexagons},
        {{"image", {"image", "image_size", "strut"}, {"threshold", "invert"}}, image},
        {{"by-example",
          {"image", "image_size", "strut"},
          {"threshold", "invert", "gap", "reinforce", "self_supporting", "direction", "seed", "second_image",
           "second_weight"}},
         by_example},
        {{"elements", {}, {}}, elements}};
    return list;
}

bool has_cut_skin(const Recipe& recipe) {
    return recipe.skin &&
           (recipe.skin->pattern != "closed" || recipe.skin->drains > 0 || !recipe.holes.empty());
}

FieldPtr cut_windows(const Recipe& recipe, FieldPtr shell, const TurnedBody& body, double depth,
                     Gradings& gradings, const PatternWork& work, std::optional<PatternReport>& report) {
    for (const PatternBuilder& builder : pattern_builders()) {
        if (builder.kind.word != recipe.skin->pattern || !builder.cut) continue;
        report.emplace().pattern = builder.kind.word;
        try {
            PatternBuildContext making{recipe, shell, body.field, body.axes, depth, gradings, work, *report};
            return builder.cut(making);
        } catch (const LocatedError&) {
            throw;
        } catch (const InputError& error) {
            throw LocatedError("skin (" + builder.kind.word + "): " + error.what());
        }
    }
    return shell;
}

DrilledHole drill(const Field& body, dvec3 at, dvec3 direction, double radius, double deep, double depth) {
    const auto foot = foot_on_surface(body, at, 1e-4 * radius);
    if (!foot) {
        throw InputError(
            fmt::format("no point of the surface can be told to be the nearest to ({}, {}, {}) "
                        "mm; accepted: a point nearer to the surface",
                        at.x, at.y, at.z));
    }
    const double given = length(direction);
    const dvec3 inward = given > 0 ? direction / given : -foot->normal;
    const double cosine = -glm::dot(inward, foot->normal);
    constexpr double flattest = 0.1;
    if (cosine < flattest) {
        throw InputError(fmt::format(
            "the direction ({}, {}, {}) does not lead into the body, whose outward normal is "
            "({:.4g}, {:.4g}, {:.4g}) there; accepted: one within 84 degrees of its opposite",
            direction.x, direction.y, direction.z, foot->normal.x, foot->normal.y, foot->normal.z));
    }
    // A round skin is met later at the hole's rim than in its middle, an oblique one later on one side.
    const double slant = radius * std::sqrt(1 - std::min(cosine * cosine, 1.0)) / cosine;
    const double through_skin = depth / cosine + slant + radius;
    return {foot->place - inward * (slant + radius), foot->place + inward * (deep > 0 ? deep : through_skin),
            radius, false};
}

std::vector<DrilledHole> drilled_holes(const Recipe& recipe, const TurnedBody& body, double depth) {
    std::vector<DrilledHole> holes;
    for (const HoleRecipe& hole : recipe.holes) {
        try {
            holes.push_back(drill(*body.field, body.axes * hole.at, body.axes * hole.direction, hole.radius,
                                  hole.depth, depth));
            holes.back().through = hole.through;
        } catch (const InputError& error) {
            throw LocatedError(hole.where + ": " + error.what());
        }
    }
    return holes;
}

FieldPtr without_holes(FieldPtr solid, std::span<const DrilledHole> holes) {
    if (holes.empty()) return solid;
    std::vector<FieldPtr> cylinders;
    cylinders.reserve(holes.size());
    for (const DrilledHole& hole : holes) cylinders.push_back(make_cylinder(hole.from, hole.to, hole.radius));
    return make_difference(std::move(solid), make_union(std::move(cylinders)));
}

}  // namespace lamella
