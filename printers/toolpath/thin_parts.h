// What of a layer's island is so thin that one bead along its middle fills it.
#pragma once

#include "printers/polygons/medial_axis.h"

namespace lamella {

/// A line with the thickness at each of its points of what it runs along, mm.
struct TaperedLine {
    std::vector<dvec2> points;
    std::vector<double> thickness;
    bool closed = false;  ///< the last point is joined with the first
};

/// Area under the line when it is as wide as thick, mm^2: its length times its thickness.
double area_of(const TaperedLine& line);

struct ThinParts {
    std::vector<TaperedLine> lines;
    double area = 0;    ///< of what they run along, mm^2
    bool whole = true;  ///< that is all of the island
    Polygons covered;   ///< what they run along, unless that is all
};

/// The parts of an island of which the thickness is at most `thickest` mm and changes slowly along them, with
/// the lines along their middles. Lines pass straight through where several meet, and end as far before the
/// end of a part as its thickness and volume ask for; where a part is thinner than `thinnest` mm, they end.
/// `tolerance` mm is by how much lines may be simplified.
ThinParts find_thin_parts(const MedialAxis& axis, double thinnest, double thickest, double tolerance);

}  // namespace lamella
