// The data of an SVG path as polygons.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/base/geometry.h"

namespace lamella {

/// Most points of a path, and of a drawing: a few bytes of a curve become many.
inline constexpr std::size_t most_svg_points = 1'000'000;

/// A subpath, flattened.
struct SvgSubpath {
    std::vector<dvec2> points;  ///< without a repeated last point if it is closed
    bool is_closed = false;     ///< by z, or as it ends where it begins
};

/// Returns the subpaths of path data (W3C, "Scalable Vector Graphics 2", section 9.3: all of its commands),
/// in the path's own unit. Curves become chords that deviate by at most `tolerance`. Throws InputError, with
/// `where` in front, for data that is no path and for more than a million points.
std::vector<SvgSubpath> flattened_path(std::string_view data, double tolerance, const std::string& where);

/// Returns the polygon of an ellipse.
std::vector<dvec2> flattened_ellipse(dvec2 centre, dvec2 radii, double tolerance);

}  // namespace lamella
