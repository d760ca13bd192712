// Outlines of an SVG drawing.
#pragma once

#include <string>
#include <vector>

#include "engine/base/geometry.h"

namespace lamella {

/// Reads the filled shapes of an SVG file as closed polygons, in mm, y upward, about the middle of their
/// bounds: paths, polygons, rectangles, circles and ellipses, under all transforms; not what is in defs,
/// symbols, clip paths, masks and patterns, what fill is none of, or what is not displayed. A point belongs
/// to the drawing where an odd number of polygons encloses it. Sizes follow width, height and viewBox;
/// without units, 96 units are an inch. Curves become chords that deviate by at most `tolerance` mm. Throws
/// InputError for a file that is no SVG or holds no shape, for open paths, for more than a million points,
/// and for text and images, which have no outline.
std::vector<std::vector<dvec2>> read_svg_outlines(const std::string& path, double tolerance);

}  // namespace lamella
