// Center lines of walls: where one bead along the middle fills what is too thin for two.
#pragma once

#include <vector>

#include "printers/polygons/polygons.h"

namespace lamella {

/// A line along the middle of a wall, mm.
struct CenterLine {
    std::vector<dvec2> points;
    bool closed = false;  ///< the last point is joined with the first
};

double length_of(const CenterLine& line);

/// The thickness that walls of this area and outline have when it is the same everywhere, mm: exact for
/// rectangles, for what is joined of them at right angles, and for rings. One connected piece with its holes.
double wall_thickness(const Polygons& piece);

/// The lines along the middles of walls of one thickness (mm), each wall once however they branch; they end a
/// quarter of the thickness before the walls do. Empty when the piece is no such network of walls: when parts
/// of it are much thicker or thinner, or when it is hardly longer than thick. `tolerance` mm of unevenness
/// count as even.
///
/// The piece is shrunk to a ribbon round its middle; its border runs along each wall there and back, and of
/// the two ways the first is kept.
std::vector<CenterLine> center_lines(const Polygons& piece, double thickness, double tolerance);

}  // namespace lamella
