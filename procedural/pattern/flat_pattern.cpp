// Grids of a sheet, from coarse to fine; bilinear distances.
#include "procedural/pattern/flat_pattern.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/error.h"

namespace lamella {

namespace {

constexpr double most_sites = 4e6;

SoundPattern sound_sheet(const Example& example, const std::vector<PatternLevel>& levels,
                         const ExampleSettings& settings) {
    if (settings.reinforce == Reinforcement::none)
        return synthesise_example(example, levels, settings, nullptr);
    if (settings.reinforce != Reinforcement::shape)
        throw InputError("forces act on the skin of a body; accepted: reinforcement by shape");
    const SurfaceSites& sites = levels.back().sites;
    BridgesByShape by_shape(sites, bridge_settings(sites, settings));
    SoundPattern made = synthesise_example(example, levels, settings, &by_shape);
    made.cut_struts = by_shape.last().cut_struts;
    made.detours = by_shape.last().detours;
    return made;
}

}  // namespace

FlatPattern::FlatPattern(const Volume& picture, dvec2 sheet, const ExampleSettings& settings) {
    const Example example = make_example(picture, settings);
    const int finest_in_coarsest = 1 << (example.levels - 1);
    const auto sites_along = [&](double length, double spacing) {
        return finest_in_coarsest *
               std::max(1.0, std::round(std::min(length / (finest_in_coarsest * spacing), 1e6)));
    };
    const double across = sites_along(sheet.x, example.spacing);
    spacing_ = sheet.x / across;
    const double up = sites_along(sheet.y, spacing_);
    const int least = windows_in_an_example * settings.synthesis.window;
    if (std::min(across, up) < least || across * up > most_sites)
        throw InputError(
            fmt::format("a sheet of {} x {} mm has {} x {} sites of {:.3g} mm; accepted: at least {} "
                        "along each side, {} in all",
                        sheet.x, sheet.y, across, up, spacing_, least, most_sites));
    width_ = static_cast<int>(across);
    height_ = static_cast<int>(up);
    std::vector<PatternLevel> levels;
    for (int halvings = example.levels - 1; halvings >= 0; --halvings) {
        PatternLevel& level = levels.emplace_back();
        level.sites = flat_sites(width_ >> halvings, height_ >> halvings, spacing_ * (1 << halvings));
        level.windows = site_windows(level.sites, settings.synthesis.window);
    }
    pattern_ = sound_sheet(example, levels, settings);
}

double FlatPattern::distance(dvec2 at) const {
    const auto place = [](double along, int count) { return along - count * std::floor(along / count); };
    const double x = place(at.x / spacing_ - 0.5, width_), y = place(at.y / spacing_ - 0.5, height_);
    const int i = std::min(static_cast<int>(x), width_ - 1), j = std::min(static_cast<int>(y), height_ - 1);
    const auto site = [&](int column, int row) {
        return static_cast<double>(pattern_.printed.distance[static_cast<std::size_t>(row % height_) *
                                                                 static_cast<std::size_t>(width_) +
                                                             static_cast<std::size_t>(column % width_)]);
    };
    const double s = x - i, t = y - j;
    const double low = site(i, j) * (1 - s) + site(i + 1, j) * s,
                 high = site(i, j + 1) * (1 - s) + site(i + 1, j + 1) * s;
    return low * (1 - t) + high * t;
}

double FlatPattern::value(dvec3 p) const {
    // Bilinear interpolation may be steeper than the distance by sqrt(2).
    constexpr double evened = 0.7071067811865475;
    const dvec2 beyond = glm::max(-dvec2(p), dvec2(p) - size());
    return std::max(-evened * distance(dvec2(p)), std::max(beyond.x, beyond.y));
}

Box FlatPattern::bounds() const {
    const dvec2 corner = size();
    return {dvec3(0, 0, -infinity), dvec3(corner.x, corner.y, infinity)};
}

}  // namespace lamella
