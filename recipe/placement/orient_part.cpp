// Samples the body, mirrored as the recipe says, and searches directions on it.
#include "recipe/placement/orient_part.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "printers/process_limits.h"
#include "printers/registry.h"
#include "recipe/build/build_body.h"
#include "recipe/placement/part_placement.h"
#include "recipe/placement/plan_orientations.h"
#include "recipe/placement/suction_cups.h"

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
        case OrientGoal::strength:
            // Whole percents of the load first; of what is equally strong, the least supports.
            return [](const OrientationFigures& f) {
                return std::round(100 * f.load_across) + f.support_volume / (1 + f.support_volume);
            };
        case OrientGoal::supports:
            break;
    }
    return [](const OrientationFigures& f) { return f.support_volume; };
}

double area_of(const SurfaceCover& cover) {
    return std::accumulate(cover.areas.begin(), cover.areas.end(), 0.0);
}

/// Returns the loads to bear: those of the options, or else the recipe's forces, by the weights of their
/// cases.
std::vector<dvec3> loads_of(const Recipe& recipe, const OrientOptions& options) {
    std::vector<dvec3> loads = options.loads;
    if (loads.empty()) {
        for (const LoadRecipe& load : recipe.loads) {
            if (load.force != dvec3(0)) loads.push_back(load.weight * load.force);
        }
    }
    if (loads.empty() && options.goal == OrientGoal::strength)
        throw InputError(
            "--for strength: no load has a direction; accepted: --load X,Y,Z, or a recipe with a [[load]] "
            "that "
            "has a force");
    return loads;
}

/// Keeps the first orientations that are far enough from all before them.
std::vector<Orientation> differing(const std::vector<Orientation>& list, std::size_t count) {
    std::vector<Orientation> kept;
    for (const Orientation& orientation : list) {
        const auto is_near = [&](const Orientation& other) {
            return dot(other.figures.up, orientation.figures.up) > std::cos(apart * std::numbers::pi / 180);
        };
        if (std::ranges::none_of(kept, is_near)) kept.push_back(orientation);
        if (kept.size() == count) break;
    }
    return kept;
}

/// Measures the suction cups of the reported orientations, side by side.
void measure_cups(const LaidPart& part, const Recipe& recipe, const OrientOptions& options,
                  OrientReport& report) {
    const PrintLimits limits = process_limits(recipe.printer);
    if (!limits.wants(Check::cups)) return;
    std::vector<Orientation*> all{&report.now};
    for (Orientation& orientation : report.best) all.push_back(&orientation);
    parallel_for(all.size(), [&](std::size_t i) {
        all[i]->cups =
            cup_volume(part.body(all[i]->lay_on), recipe.layers.height, limits.cup, {1, {}, options.cancel});
    });
}

}  // namespace

OrientReport orient_part(const Recipe& given, const OrientOptions& options) {
    const Recipe recipe = with_known_placement(given);
    PartRecipe only_mirrored = not_turned(recipe.part);
    only_mirrored.mirror = recipe.part.mirror;
    const glm::dmat3 mirror = part_axes(only_mirrored);
    Gradings gradings(recipe);
    std::optional<MeshReport> mesh;
    const FieldPtr body = build_body(recipe, gradings, mesh, mirror);
    OrientationRules rules = rules_of(recipe.printer, recipe.layers.height);
    for (const dvec3& load : loads_of(recipe, options)) rules.loads.push_back(mirror * load);
    ThreadArena arena(options.threads);
    OrientReport report;
    report.has_loads = !rules.loads.empty();
    arena.execute([&] {
        const SurfaceCover cover = cover_surface(*body, sites, options.cancel);
        const OrientationMeasure measure = [&](dvec3 up) {
            return Orientation{orientation_figures(cover, up, rules), mirror * -up};
        };
        const glm::dmat3 turn = part_axes(recipe.part) * mirror;
        report.now = measure(glm::transpose(turn) * dvec3(0, 0, 1));
        std::size_t plans = 0;
        if (options.goal == OrientGoal::supports)
            plans = options.plan.value_or(affordable_plans(
                {area_of(cover), recipe.layers.height, mesh ? mesh->triangles : 0,
                 !mesh && (!recipe.part.field.empty() || recipe.part.shape == Shape::gyroid)}));
        std::vector<Orientation> list;
        for (const OrientationFigures& figures : best_orientations(
                 cover, rules, score_of(options.goal), std::max(options.count, plans), apart, options.cancel))
            list.push_back({figures, mirror * -figures.up});
        const LaidPart part(recipe);
        if (plans > 0) {
            plan_orientations(part, plans, measure, options, list);
            report.now.planned = part.support_volume(report.now.lay_on, options.threads, options.cancel);
        }
        report.best = differing(list, options.count);
        measure_cups(part, recipe, options, report);
    });
    return report;
}

}  // namespace lamella
