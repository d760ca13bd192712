// The shortest way between two points inside polygons with holes.
#pragma once

#include <optional>
#include <vector>

#include "printers/polygons/polygon_sight.h"

namespace lamella {

/// The corners of the shortest way from one point to another, both inside, ends left out: empty where they
/// see each other, nothing where no way leads across or the search took too many steps.
///
/// The search is A* over the corners at which the border bends inward; who sees whom is found out only where
/// it comes to that. It looks at the corners of an ellipse round both points first, and at larger ones as
/// long as it finds nothing: what lies outside cannot be on a shorter way. After `max_steps` pairs of
/// corners and edges it gives up. Ways longer than `longest`, in units, are not looked for. The result
/// depends on the arguments alone.
std::optional<std::vector<PolygonSight::Point>> shortest_way(const PolygonSight& inside,
                                                             PolygonSight::Point from, PolygonSight::Point to,
                                                             double longest = infinity,
                                                             std::int64_t max_steps = 200'000);

}  // namespace lamella
