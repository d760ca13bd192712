// Walks up the steps of [layers], or follows the slopes of the surface.
#include "recipe/layering/plan_layers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/surveys/adaptive_layers.h"

namespace lamella {

namespace {

constexpr double rounding = 1e-6;  // layers
constexpr double max_layers = 10'000'000;

/// From a height over the bed on, layers have this height; mm.
struct HeightStep {
    double from, height;
};

Interval raised(const Interval& z, double by) { return {z.lo + by, z.hi + by}; }

/// Replaces the steps between two heights over the bed by one.
void set_band(std::vector<HeightStep>& steps, const Interval& z, double height) {
    const auto above = std::ranges::find_if(steps, [&](const HeightStep& step) { return step.from > z.hi; });
    const double height_above = std::prev(above)->height;
    const auto first = std::ranges::find_if(steps, [&](const HeightStep& step) { return step.from >= z.lo; });
    const auto place = steps.erase(first, above);
    steps.insert(place, {HeightStep{z.lo, height}, HeightStep{z.hi, height_above}});
}

/// Returns the steps of a recipe, the lowest first; the first begins at the bed. Bands are given by their
/// heights over the bed.
std::vector<HeightStep> steps_of(const LayersRecipe& layers, const std::vector<HeightBand>& bands = {}) {
    std::vector<HeightStep> steps{{0, layers.height}};
    for (const std::vector<double>& row : layers.heights) {
        if (row[0] == 0) steps.clear();
        steps.push_back({row[0], row[1]});
    }
    for (const HeightBand& band : bands) set_band(steps, band.z, band.height);
    if (layers.first > 0) {
        // What would begin within the first layer begins above it.
        while (steps.size() > 1 && steps[1].from <= layers.first) steps.erase(steps.begin());
        steps.front().from = layers.first;
        steps.insert(steps.begin(), {0, layers.first});
    }
    return steps;
}

/// Returns the layers from one height over the bed to another; the last is the one whose lowest cutting
/// plane, at this share of it, still lies below.
LayerPlan layers_between(const std::vector<HeightStep>& steps, double from, double to, double lowest_plane) {
    std::vector<EqualLayers> layers;
    double z = from;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const double height = steps[i].height;
        const double end = i + 1 < steps.size() ? steps[i + 1].from : infinity;
        if (z >= end - rounding * height) continue;
        if (!layers.empty() && to - z <= (lowest_plane + rounding) * height) break;
        if ((to - z) / height > max_layers) {
            throw InputError(fmt::format(
                "layers.height / --layer-height: {} mm cuts a part of {} mm into more than {:.0f} "
                "layers; accepted: {} mm or more",
                height, to - z, max_layers, (to - z) / max_layers));
        }
        const int last = count_layers(to - z, height, lowest_plane);
        const double fit = std::ceil((end - z) / height - rounding);
        if (last <= fit) {
            layers.push_back({last, height});
            break;
        }
        layers.push_back({static_cast<int>(fit), height});
        z += fit * height;
    }
    return LayerPlan(layers);
}

/// Returns layers that adapt to the surface, above a first one of its own.
PartLayers adapted(const Recipe& recipe, const Job& printed, const std::vector<HeightBand>& bands,
                   double from, const PassControl& control) {
    const LayersRecipe& layers = recipe.layers;
    AdaptiveLimits limits;
    limits.least = layers.least > 0 ? layers.least : layers.height / 2;
    limits.most = layers.most > 0 ? layers.most : 1.5 * layers.height;
    limits.cusp = layers.cusp;
    for (const HeightBand& band : bands)
        limits.bands.push_back({raised(band.z, -printed.bounds.lo.z), band.height});
    constexpr double rows = 256, finest_rows = 0.05;  // along a side; mm
    const dvec3 size = printed.bounds.size();
    SlopeSurveyOptions options;
    options.threads = control.threads;
    options.cancel = control.cancel;
    options.on_progress = control.on_progress;
    options.step = limits.least / 2;
    options.pitch = std::max(std::max(size.x, size.y) / rows, finest_rows);
    if (size.z / options.step > max_layers) {
        throw InputError(fmt::format(
            "layers.least / --least-layer: {} mm is too fine for a part of {} mm; accepted: {} mm or more",
            limits.least, size.z, 2 * size.z / max_layers));
    }
    const SlopeProfile profile = survey_slopes(printed.part, printed.bounds, options);
    const double first = from == 0 ? layers.first : 0;
    const LayerPlan above = adapt_layers(profile, limits, first, size.z);
    return {first > 0 ? above.raised({1, first}) : above, greatest_cusp(profile, above, first)};
}

}  // namespace

LayerPlan lift_layers(const Recipe& recipe) {
    const double lift = recipe.printer.support.lift;
    if (recipe.support == SupportKind::none || lift == 0) return {};
    return layers_between(steps_of(recipe.layers), 0, lift, 0);
}

PartLayers part_layers(const Recipe& recipe, const Job& printed, const std::vector<HeightBand>& bands,
                       const PassControl& control) {
    const double height = printed.bounds.size().z, from = lift_layers(recipe).total();
    if (recipe.layers.cusp > 0) return adapted(recipe, printed, bands, from, control);
    std::vector<HeightBand> over_bed = bands;
    for (HeightBand& band : over_bed) band.z = raised(band.z, from - printed.bounds.lo.z);
    // Masks that average several planes of a layer begin with the lowest of them.
    const double lowest_plane = 0.5 / std::max(1, recipe.printer.image.sub_layers);
    return {layers_between(steps_of(recipe.layers, over_bed), from, from + height, lowest_plane), {}};
}

}  // namespace lamella
