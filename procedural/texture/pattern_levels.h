// Synthesis from coarse to fine.
#pragma once

#include <functional>
#include <vector>

#include "procedural/texture/texture_synthesis.h"

namespace lamella {

/// The sites of one grid, and their windows.
struct PatternLevel {
    SurfaceSites sites;
    SiteWindows windows;
};

/// Returns the exemplar for sites whose spacing is that of the last level, doubled so many times.
using ExemplarOfLevel = std::function<Exemplar(const SurfaceSites& sites, int doublings)>;

/// Synthesises on each level in turn, the coarsest first; each has half the spacing of the one before it, and
/// begins with the pattern of the nearest sites there, the first with patches of the exemplar. Throws
/// InputError for an exemplar that is smaller than a window at some level.
SynthesisResult synthesise_levels(const std::vector<PatternLevel>& levels, const ExemplarOfLevel& exemplar,
                                  const SynthesisSettings& settings);
/// The same for one picture in black and white, `width` pixels across at the last level.
SynthesisResult synthesise_levels(const std::vector<PatternLevel>& levels, const GreyImage& black_and_white,
                                  int width, const SynthesisSettings& settings);

/// Returns the threshold of distances above which as large a share of the sites is solid as is of the
/// exemplar, in black and white.
float threshold_for_share(const SitePattern& pattern, double share);

}  // namespace lamella
