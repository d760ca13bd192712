// Rounds of matching and voting.
#include "procedural/texture/texture_synthesis.h"

#include <string>

#include "engine/base/error.h"
#include "procedural/texture/window_matches.h"
#include "procedural/texture/window_votes.h"

namespace lamella {

SynthesisResult synthesise(const SiteWindows& windows, const Exemplar& exemplar, SitePattern start,
                           std::span<const std::uint8_t> fixed, int level,
                           const SynthesisSettings& settings) {
    const std::size_t sites = windows.sites.size() / windows.area();
    const bool begins = start.solid.empty();
    if (begins) start = {std::vector<float>(sites, 0.5F), std::vector<float>(sites, 0.5F)};
    if (start.solid.size() != sites || start.distance.size() != sites ||
        (!fixed.empty() && (fixed.size() != sites || begins)))
        throw InputError("a start of " + std::to_string(start.solid.size()) + " sites; expected " +
                         std::to_string(sites));
    WindowMatches matches(windows, exemplar, level, settings);
    const WindowVotes votes(windows, exemplar);
    SynthesisResult result;
    result.pattern = std::move(start);
    if (begins) {
        matches.begin_with_patches();
        votes.vote(matches, fixed, result.pattern);
    }
    constexpr int first_sweeps = 8;
    for (int round = 0; round < settings.rounds; ++round) {
        matches.sweep(result.pattern, round == 0 ? first_sweeps : 1);
        votes.vote(matches, fixed, result.pattern);
    }
    for (const float difference : matches.differences()) result.energy += static_cast<double>(difference);
    result.energy /= static_cast<double>(sites);
    for (const ExemplarPixel match : matches.matches())
        result.matches.push_back(static_cast<std::uint32_t>(exemplar.solid.index(match.x, match.y)));
    return result;
}

}  // namespace lamella
