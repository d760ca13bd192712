// The search for the directions along which a body is best printed.
#pragma once

#include <functional>
#include <vector>

#include "procedural/orientation/orientation_figures.h"

namespace lamella {

/// What an orientation is to be good for; less is better.
using OrientationScore = std::function<double(const OrientationFigures&)>;

/// Returns directions to print a body along: opposite to each of its faces of at least half a percent of the
/// surface, the largest first, and `on_sphere` directions spread evenly over the sphere.
std::vector<dvec3> candidate_directions(const SurfaceCover& cover, int on_sphere);

/// Returns the best orientations, the best first, at least `apart` degrees from each other. All candidates
/// are measured, and the best of those on the sphere are then turned as long as that improves them. The same
/// for any number of threads; runs in the caller's arena. Throws Interrupted when cancelled.
std::vector<OrientationFigures> best_orientations(const SurfaceCover& cover, const OrientationRules& rules,
                                                  const OrientationScore& score, std::size_t wanted,
                                                  double apart, const CancelToken* cancel);

}  // namespace lamella
