// WindowVotes: the pattern that the matches of all windows propose.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "procedural/texture/texture_synthesis.h"
#include "procedural/texture/window_matches.h"

namespace lamella {

/// Each site takes the weighted mean of the pixels that the windows over it are matched with. A window that
/// resembles its match counts more, and so does one whose middle is near: its weight is
/// exp(-(distance^2) / (r^2 / 2)) / (0.001 + difference^1.2), r half the window. Pixels of distances that the
/// pattern has more often than the exemplar count less (Kopf et al. 2007, "Solid texture synthesis from 2D
/// exemplars", section 3.3), which keeps the solid share. Sums have a fixed order.
class WindowVotes {
  public:
    /// The windows and the exemplar have to outlive the object.
    WindowVotes(const SiteWindows& windows, const Exemplar& exemplar);

    /// Replaces the pattern at all sites but those with a number other than 0 in `fixed`.
    void vote(const WindowMatches& matches, std::span<const std::uint8_t> fixed, SitePattern& pattern) const;

  private:
    /// Returns by pixel of the exemplar how much it counts, given the pattern.
    std::vector<float> rarity(const SitePattern& pattern) const;

    const SiteWindows& windows_;
    const Exemplar& exemplar_;
    std::vector<float> falloff_;         ///< by place in the window
    std::vector<std::size_t> first_;     ///< of each site in `covers_`, and the end
    std::vector<std::uint32_t> covers_;  ///< windows over a site: site * 128 + place in the window
};

}  // namespace lamella
