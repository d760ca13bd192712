// Rounds of matching and voting.
#include "procedural/texture/texture_synthesis.h"

#include <algorithm>
#include <string>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "procedural/texture/window_matches.h"
#include "procedural/texture/window_votes.h"

namespace lamella {

namespace {

std::vector<std::uint32_t> pixel_numbers(const WindowMatches& matches, const Exemplar& exemplar) {
    std::vector<std::uint32_t> numbers;
    numbers.reserve(matches.matches().size());
    for (const ExemplarPixel match : matches.matches())
        numbers.push_back(static_cast<std::uint32_t>(exemplar.solid.index(match.x, match.y)));
    return numbers;
}

}  // namespace

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
    result.matches = pixel_numbers(matches, exemplar);
    return result;
}

void resynthesise(const SiteWindows& windows, const Exemplar& exemplar, std::span<const std::uint8_t> fixed,
                  int level, const SynthesisSettings& settings, SynthesisResult& found) {
    constexpr int rounds = 3, first_sweeps = 2;
    std::vector<std::uint8_t> kept(fixed.size());
    parallel_for(fixed.size(), [&](std::size_t i) {
        const auto window = windows.of(i);
        kept[i] = std::ranges::all_of(window, [&](std::uint32_t site) { return fixed[site] != 0; }) ? 1 : 0;
    });
    WindowMatches matches(windows, exemplar, level, settings);
    matches.begin_with(found.matches, std::move(kept));
    const WindowVotes votes(windows, exemplar);
    for (int round = 0; round < rounds; ++round) {
        matches.sweep(found.pattern, round == 0 ? first_sweeps : 1);
        votes.vote(matches, fixed, found.pattern);
    }
    found.matches = pixel_numbers(matches, exemplar);
}

}  // namespace lamella
