// Where pins through a stack of layers keep each of them from being turned over.
#pragma once

#include <vector>

#include "printers/polygons/polygons.h"

namespace lamella {

/// Two or three places within `clear`, as far apart as a search over some hundred candidates finds, at least
/// three diameters; fewer (none) where there is no room.
///
/// Three make a triangle whose sides differ by at least a diameter, which is as high as that: it fits one
/// way only. Two pins fit their own layer turned about the line through them, always; they are placed such
/// that a layer turned over about the middle lines of its bounds, or by half a turn about its `middle`, has
/// a hole at least a diameter off.
std::vector<dvec2> dowel_places(const Polygons& clear, dvec2 middle, int count, double diameter);

/// Whether a point lies within polygons whose holes run clockwise, borders included.
bool is_inside(const Polygons& polygons, dvec2 point);

}  // namespace lamella
