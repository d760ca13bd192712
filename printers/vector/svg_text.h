// Building blocks of SVG files: a page in true millimetres, and path data.
#pragma once

#include <string>
#include <vector>

#include "engine/base/geometry.h"
#include "printers/common/profile.h"

namespace lamella {

inline constexpr int svg_decimals = 4;  ///< decimals of a coordinate in mm: 0.1 um

/// Throws InputError for an invalid margin or tolerance.
void check_page(const VectorProfile& profile);

/// Returns the text before the first group. Width and height carry the unit and the viewBox has the same
/// numbers.
std::string svg_start(dvec2 size);
inline constexpr const char* svg_end = "</svg>\n";

/// Appends a polyline. The corner `left_top` of the page is the origin, and y is flipped to point downwards.
void append_svg_line(std::string& data, const std::vector<dvec2>& points, bool closed, dvec2 left_top);

}  // namespace lamella
