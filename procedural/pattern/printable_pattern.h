// PrintablePattern: a synthesised pattern in one piece, with least widths.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "procedural/pattern/site_distance.h"
#include "procedural/texture/texture_synthesis.h"

namespace lamella {

struct PrintSettings {
    double share = 0.5;  ///< of the surface that is to be solid
    double strut = 0.8;  ///< least width of struts, mm
    double gap = 0;      ///< least width of gaps, mm; 0: any
    double limit = 1;    ///< largest distance that is told, mm
    /// Solid share at which to cut the pattern first, as an earlier result's `cut_share`; without: `share`.
    std::optional<double> cut_share = {};
};

struct PrintablePattern {
    std::vector<float> distance;  ///< from the border, mm, positive in the solid, by site
    double share = 0;             ///< of the surface that is solid
    double cut_share = 0;         ///< of the pattern that lies above its threshold
    std::size_t pieces = 0;       ///< before they were joined, without those that were dropped
    std::size_t dropped = 0;      ///< pieces too small to keep
    std::vector<SiteLine> joins;  ///< the middle lines of struts that join pieces
};

/// Returns the solid share of a surface by distances of its sites, mm, `spacing` mm apart. A site near the
/// border counts by how much of its surroundings is solid: struts along rows of sites would be as wide as
/// rows are many.
double solid_share(std::span<const float> distances, double spacing);

/// Adds struts of this width, mm, to the distances, mm, by site.
void add_struts(const SurfaceSites& sites, std::span<const SiteLine> lines, double strut,
                std::vector<float>& distances);

/// Cuts the pattern where its distance exceeds a threshold, such that the solid share is the wanted one once
/// gaps and struts have their least widths (struts have precedence), pieces smaller than a disc of one and a
/// half struts' diameter are dropped, and the others joined by struts along lines_between(): each component
/// of the surface bears one piece. Pieces that merely touch are joined as well. Struts along `bridges` are
/// added in any case. The threshold keeps four fifths of the pattern's solid and of its void, so lines
/// narrower than the least width change the share. Throws InputError for a pattern that is all solid or all
/// void.
PrintablePattern printable_pattern(const SurfaceSites& sites, const SiteWindows& windows,
                                   const SitePattern& pattern, std::span<const SiteLine> bridges,
                                   const PrintSettings& settings);

}  // namespace lamella
