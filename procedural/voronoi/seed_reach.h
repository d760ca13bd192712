// Bounds how far the Voronoi cells of the seeds in a box reach beyond it.
#pragma once

#include <cstdint>

#include "procedural/voronoi/seed_tree.h"

namespace lamella {

/// Returns the reach of the seeds in a box, mm: an upper bound of the distance from each of these seeds to
/// any point of its Voronoi cell. The result is never below `at_least`, a reach that is already known; a
/// larger one prunes more of the search.
///
/// Why it holds: every point of a seed's cell is at least as near to that seed as to any other, so its
/// distance to the seed is at most the radius of the largest empty ball centred at that point. The ball is
/// smaller than the diagonal of the smallest tree node around the point that is sure to hold a seed. Hence
/// the reach is the largest such diagonal among the nodes that lie within that same diagonal of the box.
double seed_reach(const SeedTree& tree, const Box& box, double at_least = 0);

}  // namespace lamella
