// The convex hull of points in the plane.
#pragma once

#include <vector>

#include "engine/base/geometry.h"

namespace lamella {

/// Returns the convex hull, counter-clockwise, without points on its edges (Andrew's monotone chain): one
/// point or two where all points are equal or in a line.
std::vector<dvec2> convex_hull(std::vector<dvec2> points);

/// Returns the distance of a point inside a convex hull from its nearest edge; negative: outside, the
/// distance from the hull. Minus infinity for a hull without points.
double depth_in_hull(const std::vector<dvec2>& hull, dvec2 point);

}  // namespace lamella
