// Centre lines of walls that are too thin for two beads; one bead along the middle fills them.
#pragma once

#include <vector>

#include "printers/polygons/polygons.h"

namespace lamella {

/// The centre line of a wall, mm.
struct CenterLine {
    std::vector<dvec2> points;
    bool closed = false;  ///< the last point is joined to the first
};

double length_of(const CenterLine& line);

/// Returns the thickness of walls with this area and outline, assuming that it is uniform, mm. Exact for
/// rectangles, for rectangles joined at right angles, and for rings. `piece` is one connected piece with its
/// holes.
double wall_thickness(const Polygons& piece);

/// Returns the centre lines of walls of uniform thickness (mm), each wall once, however the walls branch.
/// Lines end a quarter of the thickness before the walls do. Empty if the piece is not such a network: if
/// parts of it are much thicker or thinner, or if it is hardly longer than thick. Unevenness up to
/// `tolerance` mm is ignored.
///
/// The piece is eroded to a ribbon around its middle. The ribbon's border runs along each wall in both
/// directions; of the two passes the first is kept.
std::vector<CenterLine> center_lines(const Polygons& piece, double thickness, double tolerance);

}  // namespace lamella
