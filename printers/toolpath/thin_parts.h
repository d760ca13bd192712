// ThinParts: the parts of an island so thin that one bead along their middle fills them.
#pragma once

#include "printers/polygons/medial_axis.h"

namespace lamella {

/// A centre line, with the thickness of the part at each of its points, mm.
struct TaperedLine {
    std::vector<dvec2> points;
    std::vector<double> thickness;
    bool closed = false;  ///< the last point is joined to the first
};

/// Returns the area covered by the line at its thickness, mm^2: length times thickness.
double area_of(const TaperedLine& line);

struct ThinParts {
    std::vector<TaperedLine> lines;
    double area = 0;    ///< area of the thin parts, mm^2
    bool whole = true;  ///< the thin parts are the whole island
    Polygons covered;   ///< the thin parts and a little beyond the border, unless they are the whole island
};

/// Finds the parts of an island whose thickness is at most `thickest` mm and varies slowly along them, and
/// their centre lines. Lines pass straight through junctions. They end before the end of a part, at a
/// distance that follows from its thickness and volume, and wherever the part becomes thinner than `thinnest`
/// mm. Lines are simplified within `tolerance` mm.
ThinParts find_thin_parts(const MedialAxis& axis, double thinnest, double thickest, double tolerance);

}  // namespace lamella
