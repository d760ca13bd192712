// Texture synthesis: solid and void on sites, such that the window of each site looks like one of an
// exemplar.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/base/cancel_token.h"
#include "procedural/texture/exemplar.h"
#include "procedural/texture/site_windows.h"

namespace lamella {

struct SynthesisSettings {
    int window = 9;     ///< width of the windows, sites: odd, 3 to 11
    int rounds = 6;     ///< of matching and voting
    double spread = 2;  ///< weight of the uniformity term; 0: parts of the exemplar may repeat without end
    std::uint64_t seed = 1;
    const CancelToken* cancel = nullptr;  ///< may be null
};

/// The pattern at sites.
struct SitePattern {
    std::vector<float> solid;     ///< from 0, void, to 1
    std::vector<float> distance;  ///< as Exemplar::distance
};

/// What the sites of a grid are matched with, and the pattern there.
struct SynthesisResult {
    SitePattern pattern;
    std::vector<std::uint32_t> matches;  ///< by site the pixel of the exemplar, row * width + column
    double energy =
        0;  ///< mean over sites of the difference to the match, a pixel of the window: see synthesise()
};

/// Synthesises a pattern by energy minimisation (Kwatra, Essa, Bobick, Kwatra 2005, "Texture optimization for
/// example-based synthesis"), with correspondences by PatchMatch (Barnes et al. 2009). The energy is the sum
/// over sites of the difference to the most similar window of the exemplar: over its pixels, the squared
/// differences of solidity and of distance. To it comes `spread` times by how much, as a
/// share, a window of the exemplar is used more often than the mean (after Kaspar et al. 2015).
///
/// Each round improves the matches, from those of sites 1, 2 and 4 steps away and random places, all sites at
/// once; then each site takes the mean of what the windows over it propose, similar ones with more weight.
/// The same bits on any number of threads. `start` is the pattern at first; if it is empty, patches of the
/// exemplar are. Sites with a number other than 0 in `fixed`, which may be empty, keep it. `level`
/// distinguishes the random numbers of several grids. Throws InputError for an exemplar smaller than a
/// window, Interrupted when cancelled.
SynthesisResult synthesise(const SiteWindows& windows, const Exemplar& exemplar, SitePattern start,
                           std::span<const std::uint8_t> fixed, int level, const SynthesisSettings& settings);

/// Synthesises a found pattern anew at the sites with 0 in `fixed`: a few rounds that begin with its matches,
/// of those windows alone that such sites lie in. The others may have changed since, and their neighbours
/// follow.
void resynthesise(const SiteWindows& windows, const Exemplar& exemplar, std::span<const std::uint8_t> fixed,
                  int level, const SynthesisSettings& settings, SynthesisResult& found);

}  // namespace lamella
