// From pictures to versions of all sizes, and to exemplars with a part for each.
#include "procedural/pattern/pattern_example.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/base/deterministic_math.h"
#include "engine/base/error.h"

namespace lamella {

namespace {

constexpr double sites_in_a_strut = 4;
constexpr double size_ratio = 1.2;  // of one version to the next
constexpr int most_sizes = 8;

void check(const ExampleSettings& settings) {
    const auto is_length = [](double v) { return v > 0 && std::isfinite(v); };
    if (!is_length(settings.size) || !is_length(settings.strut) ||
        !(settings.gap == 0 || is_length(settings.gap)))
        throw InputError(
            fmt::format("a picture {} mm wide with struts of {} mm and gaps of {} mm; expected positive "
                        "lengths",
                        settings.size, settings.strut, settings.gap));
    if (settings.threshold && !(*settings.threshold >= 0 && *settings.threshold <= 1))
        throw InputError(fmt::format("a threshold of {}; expected 0 to 1", *settings.threshold));
    if (settings.graded_size && !(settings.least_size > 0 && settings.least_size <= settings.size))
        throw InputError(fmt::format("pictures {} to {} mm wide; expected positive lengths",
                                     settings.least_size, settings.size));
    if ((settings.second.picture != nullptr) != (settings.second.weight != nullptr))
        throw InputError("a second picture goes with its weight; expected both or none");
}

GreyImage black_and_white_of(const Volume& picture, const ExampleSettings& settings) {
    const GreyImage solid = solidity(picture, settings.invert);
    double level = otsu_threshold(solid);
    // Darker than the threshold, or at least as light.
    if (settings.threshold)
        level = settings.invert ? *settings.threshold : std::nextafter(1 - *settings.threshold, 2.0);
    GreyImage image = black_and_white(solid, level);
    const double share = mean_of(image);
    if (share == 0 || share == 1)
        throw InputError(
            fmt::format("the picture is all {}; accepted: another threshold", share == 0 ? "void" : "solid"));
    return image;
}

/// Returns the widths (mm) of the versions of a picture, the largest first, each at most a fifth larger than
/// the next.
std::vector<double> versions(const ExampleSettings& settings) {
    if (!settings.graded_size) return {settings.size};
    const double ratios = logarithm(settings.size / settings.least_size) / logarithm(size_ratio);
    const int steps = static_cast<int>(std::ceil(ratios - 1e-9));
    if (steps >= most_sizes)
        throw InputError(fmt::format(
            "pictures {:.4g} to {:.4g} mm wide; accepted: the largest at most {:.2g} times the smallest",
            settings.least_size, settings.size, power(size_ratio, most_sizes - 1)));
    std::vector<double> sizes{settings.size};
    for (int i = 1; i <= steps; ++i)
        sizes.push_back(settings.size *
                        power(settings.least_size / settings.size, i / static_cast<double>(steps)));
    return sizes;
}

/// Returns the width of a picture of this size, in sites.
int width_of(const GreyImage& picture, double size, double spacing) {
    return std::min(static_cast<int>(std::lround(size / spacing)), picture.width);
}

/// Sets the weights of numbers 0, 1, ... for a place between two of them: by linear interpolation. A place
/// before the first, or none (NaN), counts as the first, and one beyond the last as the last.
void interpolation_weights(double place, std::vector<double>& weights) {
    const double last = static_cast<double>(weights.size() - 1);
    if (!(place >= 0)) place = 0;
    place = std::min(place, last);
    for (std::size_t i = 0; i < weights.size(); ++i)
        weights[i] = std::max(0.0, 1 - std::abs(place - static_cast<double>(i)));
}

}  // namespace

Exemplar Example::exemplar(const SurfaceSites& sites, int doublings, const ExampleSettings& settings) const {
    const double finest = sites.spacing / (1 << doublings);
    std::vector<Exemplar> parts;
    for (const GreyImage& picture : pictures) {
        for (const double size : sizes)
            parts.push_back(
                make_exemplar(picture, std::max(1, width_of(picture, size, finest) >> doublings)));
    }
    if (parts.size() == 1) return std::move(parts.front());
    std::vector<float> weights;
    weights.reserve(parts.size() * sites.size());
    std::vector<double> by_picture(pictures.size(), 1), by_size(sizes.size(), 1);
    const double step = sizes.size() > 1 ? logarithm(sizes[0] / sizes[1]) : 1;
    for (const dvec3 place : sites.places) {
        if (pictures.size() > 1) interpolation_weights(settings.second.weight->at(place), by_picture);
        if (sizes.size() > 1)
            interpolation_weights(logarithm(sizes[0] / settings.graded_size->at(place)) / step, by_size);
        for (const double of_picture : by_picture) {
            for (const double of_size : by_size) weights.push_back(static_cast<float>(of_picture * of_size));
        }
    }
    return stacked(parts, std::move(weights));
}

double Example::share(const Exemplar& exemplar) const {
    double sum = 0;
    for (std::size_t part = 0; part < exemplar.parts.size(); ++part)
        sum += exemplar.parts[part].weight * mean_of(pictures[part / sizes.size()]);
    return sum;
}

Example make_example(const Volume& picture, const ExampleSettings& settings) {
    check(settings);
    Example example;
    example.pictures.push_back(black_and_white_of(picture, settings));
    if (settings.second.picture)
        example.pictures.push_back(black_and_white_of(*settings.second.picture, settings));
    example.sizes = versions(settings);
    example.spacing = settings.strut / sites_in_a_strut;
    for (const GreyImage& image : example.pictures)
        example.spacing = std::max(example.spacing, settings.size / image.width);
    const int window = settings.synthesis.window;
    int least = std::numeric_limits<int>::max();
    for (const GreyImage& image : example.pictures) {
        const double proportion = static_cast<double>(image.height) / image.width;
        const int across = width_of(image, example.sizes.back(), example.spacing);
        least = std::min(least, static_cast<int>(across * std::min(proportion, 1.0)));
        if (least < windows_in_an_example * window)
            throw InputError(fmt::format(
                "the picture covers {} x {} points of the pattern, {:.3g} mm apart, and {} along each side "
                "are needed; accepted: a picture of more pixels, printed larger, or a narrower strut",
                across, static_cast<int>(across * proportion), example.spacing,
                windows_in_an_example * window));
    }
    // The coarsest picture holds whole windows, in which the largest parts of the pattern are seen at once.
    constexpr double windows_at_the_coarsest = 2.5;
    while ((least >> example.levels) >= windows_at_the_coarsest * window) ++example.levels;
    return example;
}

BridgeSettings bridge_settings(const SurfaceSites& sites, const ExampleSettings& settings) {
    return {.strut = settings.strut,
            .apart = 2 * settings.synthesis.window * sites.spacing,
            .cancel = settings.synthesis.cancel};
}

SoundPattern synthesise_example(const Example& example, const std::vector<PatternLevel>& levels,
                                const ExampleSettings& settings, BridgeChoice* choice) {
    const PatternLevel& finest = levels.back();
    SynthesisResult found = synthesise_levels(
        levels,
        [&](const SurfaceSites& sites, int doublings) {
            return example.exemplar(sites, doublings, settings);
        },
        settings.synthesis);
    const Exemplar exemplar = example.exemplar(finest.sites, 0, settings);
    const PrintSettings print{.share = example.share(exemplar),
                              .strut = settings.strut,
                              .gap = settings.gap,
                              .limit = std::max(settings.strut, settings.gap)};
    SoundPattern made = sound_pattern(finest, exemplar, std::move(found), settings.synthesis, print, choice);
    made.wanted_share = print.share;
    return made;
}

}  // namespace lamella
