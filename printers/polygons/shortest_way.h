// Shortest path between two points inside polygons with holes.
#pragma once

#include <optional>
#include <vector>

#include "printers/polygons/polygon_sight.h"

namespace lamella {

/// Returns the inner corners of the shortest path between two points that both lie inside. The result is
/// empty if they see each other, and nothing if there is no path or the search took too many steps.
///
/// The search is A* over the reflex corners of the border; visibility is tested lazily, when a pair comes up.
/// It first searches the corners in an ellipse around both points, then in larger ellipses as long as it
/// finds nothing: a corner outside the ellipse cannot be on a shorter path. It gives up after `max_steps`
/// pairs of corners and edges, and ignores paths longer than `longest` units. The result depends on the
/// arguments alone.
std::optional<std::vector<PolygonSight::Point>> shortest_way(const PolygonSight& inside,
                                                             PolygonSight::Point from, PolygonSight::Point to,
                                                             double longest = infinity,
                                                             std::int64_t max_steps = 200'000);

}  // namespace lamella
