// Least widths of a pattern's struts and gaps.
#pragma once

#include <span>
#include <vector>

#include "procedural/pattern/site_distance.h"
#include "procedural/texture/site_windows.h"

namespace lamella {

/// Returns distances (mm, positive in the solid) of a pattern whose struts are at least `width` wide, given
/// those of one with struts of any width. What holds a disc of that diameter stays. Of the rest, a strut
/// (which ends more than half a width from what is wide enough, or joins two places of it) is widened about
/// its medial line, and a mere corner is rounded. With the sign changed it does the same for gaps.
std::vector<float> with_least_width(const SurfaceSites& sites, const SiteWindows& windows,
                                    std::span<const float> distances, double width);

/// Returns distances (mm) of the solid within half a width of the points of lines: points may be up to one
/// and a half spacings apart, and the solid is as wide between them.
std::vector<float> struts_along(const SurfaceSites& sites, std::span<const SitePoint> line, double width,
                                double limit);

}  // namespace lamella
