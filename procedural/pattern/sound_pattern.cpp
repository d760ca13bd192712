// Rounds of printing, choosing bridges and local synthesis.
#include "procedural/pattern/sound_pattern.h"

#include <algorithm>
#include <utility>

#include "procedural/pattern/least_widths.h"
#include "procedural/pattern/thin_walls.h"

namespace lamella {

namespace {

/// Gives the backs of thin walls the pattern of their fronts.
void copy_to_backs(const SurfaceSites& sites, std::span<const std::uint32_t> backs, SitePattern& pattern) {
    copy_across(sites, backs, pattern.solid);
    copy_across(sites, backs, pattern.distance);
}

/// Gives the backs the pattern of the fronts, and synthesises anew what is beside them.
void match_backs(const PatternLevel& level, const Exemplar& exemplar, std::span<const std::uint32_t> backs,
                 int round, const SynthesisSettings& synthesis, SynthesisResult& found) {
    if (backs.empty()) return;
    copy_to_backs(level.sites, backs, found.pattern);
    std::vector<std::uint8_t> fixed(level.sites.size(), 1);
    for (const std::uint32_t site : backs) {
        for (const std::uint32_t beside : level.windows.of(site)) fixed[beside] = 0;
    }
    for (const std::uint32_t site : backs) fixed[site] = 1;
    resynthesise(level.windows, exemplar, fixed, round, synthesis, found);
    copy_to_backs(level.sites, backs, found.pattern);
}

/// Puts bridges into a pattern, and synthesises anew what is within a window of the new ones.
void build(const PatternLevel& level, const Exemplar& exemplar, std::span<const SiteLine> bridges,
           std::size_t built, double strut, int round, const SynthesisSettings& synthesis,
           SynthesisResult& found) {
    const SurfaceSites& sites = level.sites;
    SiteLine all, added;
    for (std::size_t i = 0; i < bridges.size(); ++i) {
        all.insert(all.end(), bridges[i].begin(), bridges[i].end());
        if (i >= built) added.insert(added.end(), bridges[i].begin(), bridges[i].end());
    }
    const double reach = level.windows.size * sites.spacing;
    const std::vector<float> to_all = struts_along(sites, all, strut, strut + reach),
                             to_added = struts_along(sites, added, strut, strut + reach);
    std::vector<std::uint8_t> fixed(sites.size(), 1);
    for (std::size_t i = 0; i < sites.size(); ++i) {
        if (to_all[i] > 0) {
            const double pixels = static_cast<double>(to_all[i]) / sites.spacing;
            const auto distance = static_cast<float>(std::min(0.5 + 0.5 * pixels / Exemplar::reach, 1.0));
            found.pattern.solid[i] = 1;
            found.pattern.distance[i] = std::max(found.pattern.distance[i], distance);
        } else if (static_cast<double>(to_added[i]) > -reach) {
            fixed[i] = 0;
        }
    }
    resynthesise(level.windows, exemplar, fixed, round, synthesis, found);
}

}  // namespace

SoundPattern sound_pattern(const PatternLevel& level, const Exemplar& exemplar, SynthesisResult found,
                           const SynthesisSettings& synthesis, PrintSettings print, BridgeChoice* choice) {
    constexpr int most_rounds = 16;
    constexpr int first_round = 1000;  // of random numbers: grids have the lower ones
    SoundPattern made, best;
    double least = infinity;
    std::vector<SiteLine> bridges;
    const std::vector<std::uint32_t> backs = back_sites(level.sites);
    match_backs(level, exemplar, backs, first_round - 1, synthesis, found);
    for (int round = 0;; ++round) {
        stop_if_cancelled(synthesis.cancel);
        made.printed = printable_pattern(level.sites, level.windows, found.pattern, bridges, print);
        print.cut_share = made.printed.cut_share;  // nearly right for the next round
        const std::size_t built = bridges.size();
        if (round == 0) {
            made.pieces = made.printed.pieces;
            made.joins = made.printed.joins.size();
            bridges = made.printed.joins;
        }
        if (choice != nullptr) {
            std::vector<SiteLine> chosen = choice->choose(made.printed.distance);
            if (choice->weakness() <= least) {
                least = choice->weakness();
                best = made;
            }
            if (round == most_rounds) chosen.clear();
            made.bridges += chosen.size();
            std::ranges::move(chosen, std::back_inserter(bridges));
        }
        if (bridges.size() == built) return choice != nullptr ? best : made;
        build(level, exemplar, bridges, built, print.strut, first_round + round, synthesis, found);
        copy_to_backs(level.sites, backs, found.pattern);
    }
}

}  // namespace lamella
