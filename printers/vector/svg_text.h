// The pieces of SVG that all drawings share: a page in true millimetres, and path data.
#pragma once

#include <string>
#include <vector>

#include "engine/base/geometry.h"
#include "printers/common/profile.h"

namespace lamella {

inline constexpr int svg_decimals = 4;  ///< of a coordinate in mm: 0.1 um

/// Throws InputError when margin or tolerance make no sense.
void check_page(const VectorProfile& profile);

/// Everything before the first group. Width and height carry the unit and the viewBox has the same numbers.
std::string svg_start(dvec2 size);
inline constexpr const char* svg_end = "</svg>\n";

/// Appends a line, straight from point to point, with the corner (left, top) of the page at the origin and y
/// turned downwards.
void append_svg_line(std::string& data, const std::vector<dvec2>& points, bool closed, dvec2 left_top);

}  // namespace lamella
