// Positions of dowel holes that make each layer of a stack fit in one orientation only.
#pragma once

#include <vector>

#include "printers/polygons/polygons.h"

namespace lamella {

/// Returns two or three positions inside `clear`, as far apart as a search over some hundred candidates
/// finds, and at least three diameters. Returns fewer (or none) if there is no room.
///
/// Three positions form a triangle whose side lengths differ by at least a diameter and whose height is at
/// least a diameter, so it fits in one way only. Two pins always fit their own layer rotated about the line
/// through them. They are placed such that a layer flipped about the centre lines of its bounds, or rotated
/// by half a turn about its `middle`, has a hole that is off by at least a diameter.
std::vector<dvec2> dowel_places(const Polygons& clear, dvec2 middle, int count, double diameter);

/// Returns true if a point lies inside the polygons or on their border. Holes run clockwise.
bool is_inside(const Polygons& polygons, dvec2 point);

}  // namespace lamella
