// Samples the body, mirrored as the recipe says, and searches directions on it.
#include "recipe/placement/orient_part.h"

#include <algorithm>
#include <numbers>
#include <span>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "printers/registry.h"
#include "recipe/build/build_body.h"
#include "recipe/build/build_supports.h"
#include "recipe/placement/part_placement.h"

namespace lamella {

namespace {

constexpr std::size_t sites = 20000;
constexpr double apart = 10;  // degrees between two orientations of a report

OrientationRules rules_of(const PrinterProfile& printer, double layer_height) {
    const SupportProfile& s = printer.support;
    OrientationRules rules;
    rules.overhang = printable_overhang(printer, layer_height) / layer_height;
    rules.spacing = s.spacing;
    constexpr double quarter = std::numbers::pi / 4;
    const double wall = s.wall > 0 ? s.wall : printer.filament.line_width;
    rules.pillar_area = s.round_pillars ? quarter * s.pillar * s.pillar : wall * (2 * s.pillar - wall);
    rules.connector = s.connector;
    rules.tip_area = quarter * s.tip * s.tip;
    rules.foot_width = s.foot;
    rules.foot_volume = quarter * s.foot * s.foot * s.foot_height;
    rules.lift = s.lift;
    rules.layer_height = layer_height;
    return rules;
}

OrientationScore score_of(OrientGoal goal) {
    switch (goal) {
        case OrientGoal::height:
            return [](const OrientationFigures& f) { return f.height; };
        case OrientGoal::surface:
            return [](const OrientationFigures& f) { return f.overhang_area + f.bed_area; };
        case OrientGoal::area:
            return [](const OrientationFigures& f) { return f.largest_layer; };
        case OrientGoal::supports:
            break;
    }
    return [](const OrientationFigures& f) { return f.support_volume; };
}

/// Plans the supports of the first orientations, and sorts these by the material.
void plan_first(const Recipe& recipe, const OrientOptions& options, std::vector<Orientation>& best) {
    const auto planned = std::span(best).first(std::min(options.plan, best.size()));
    for (Orientation& orientation : planned)
        orientation.planned = planned_supports(recipe, orientation.lay_on, options);
    std::ranges::stable_sort(planned, {},
                             [](const Orientation& orientation) { return *orientation.planned; });
}

}  // namespace

double planned_supports(const Recipe& recipe, dvec3 lay_on, const OrientOptions& options) {
    Recipe solid;
    solid.part = recipe.part;
    solid.part.lay_on = lay_on;
    solid.part.turn = dvec3(0);
    solid.fields = recipe.fields;
    solid.gradings = recipe.gradings;
    solid.layers.height = recipe.layers.height;
    solid.printer = recipe.printer;
    solid.support = recipe.support == SupportKind::none ? SupportKind::pillars : recipe.support;
    BuiltJob built = build_job(solid, {.threads = options.threads, .cancel = options.cancel});
    SupportOptions planning;
    planning.plans.clear();
    planning.threads = options.threads;
    planning.cancel = options.cancel;
    add_supports(solid, built, planning);
    return support_volume(built.job);
}

OrientReport orient_part(const Recipe& given, const OrientOptions& options) {
    const Recipe recipe = with_known_placement(given);
    PartRecipe only_mirrored = not_turned(recipe.part);
    only_mirrored.mirror = recipe.part.mirror;
    const glm::dmat3 mirror = part_axes(only_mirrored);
    Gradings gradings(recipe);
    std::optional<MeshReport> mesh;
    const FieldPtr body = build_body(recipe, gradings, mesh, mirror);
    const OrientationRules rules = rules_of(recipe.printer, recipe.layers.height);
    ThreadArena arena(options.threads);
    OrientReport report;
    arena.execute([&] {
        const SurfaceCover cover = cover_surface(*body, sites, options.cancel);
        const auto placed = [&](const OrientationFigures& figures) {
            return Orientation{figures, mirror * -figures.up};
        };
        const glm::dmat3 turn = part_axes(recipe.part) * mirror;
        report.now = placed(orientation_figures(cover, glm::transpose(turn) * dvec3(0, 0, 1), rules));
        for (const OrientationFigures& figures :
             best_orientations(cover, rules, score_of(options.goal), options.count, apart, options.cancel))
            report.best.push_back(placed(figures));
    });
    if (options.goal == OrientGoal::supports) plan_first(recipe, options, report.best);
    return report;
}

}  // namespace lamella
