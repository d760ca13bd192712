// Upsampling by nearest sites; the threshold by sorting.
#include "procedural/texture/pattern_levels.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/base/error.h"

namespace lamella {

namespace {

SitePattern upsampled(const SitePattern& coarse, const SurfaceSites& from, const SurfaceSites& to) {
    SitePattern pattern;
    for (const std::uint32_t site : nearest_sites(from, to.places, to.normals)) {
        pattern.solid.push_back(coarse.solid[site]);
        pattern.distance.push_back(
            std::clamp(2 * coarse.distance[site] - 0.5F, 0.0F, 1.0F));  // pixels are half as wide
    }
    return pattern;
}

}  // namespace

SynthesisResult synthesise_levels(const std::vector<PatternLevel>& levels, const ExemplarOfLevel& exemplar,
                                  const SynthesisSettings& settings) {
    SynthesisResult result;
    for (std::size_t l = 0; l < levels.size(); ++l) {
        const int halvings = static_cast<int>(levels.size() - 1 - l);
        const SurfaceSites& sites = levels[l].sites;
        SynthesisSettings rounds = settings;
        rounds.rounds <<= halvings;  // coarse ones are cheap, and decide the structure
        SitePattern start;
        if (l > 0) start = upsampled(result.pattern, levels[l - 1].sites, sites);
        result = synthesise(levels[l].windows, exemplar(sites, halvings), std::move(start), {},
                            static_cast<int>(l), rounds);
    }
    return result;
}

SynthesisResult synthesise_levels(const std::vector<PatternLevel>& levels, const GreyImage& black_and_white,
                                  int width, const SynthesisSettings& settings) {
    return synthesise_levels(
        levels,
        [&](const SurfaceSites&, int doublings) {
            return make_exemplar(black_and_white, std::max(1, width >> doublings));
        },
        settings);
}

float threshold_for_share(const SitePattern& pattern, double share) {
    std::vector<float> sorted = pattern.distance;
    if (sorted.empty()) return 0;
    const auto rank = static_cast<std::size_t>(std::clamp((1 - share) * static_cast<double>(sorted.size()),
                                                          0.0, static_cast<double>(sorted.size() - 1)));
    std::ranges::nth_element(sorted, sorted.begin() + static_cast<std::ptrdiff_t>(rank));
    return sorted[rank];
}

}  // namespace lamella
