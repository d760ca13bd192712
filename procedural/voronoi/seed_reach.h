// How far the Voronoi cells of the seeds in a part of space reach beyond it.
#pragma once

#include <cstdint>

#include "procedural/voronoi/seed_tree.h"

namespace lamella {

/// Every point of a seed's cell is at least as near to that seed as to any other, so its distance to the seed
/// is at most the radius of the largest empty ball centred there. That ball is smaller than the diagonal of
/// the smallest node about the point that is sure to hold a seed: which is how far, place by place, a cell
/// can reach.
///
/// The reach of the seeds in a box: the largest such diagonal among the places within that same diagonal of
/// the box, mm. `at_least` is known to be reached already.
double seed_reach(const SeedTree& tree, const Box& box, double at_least = 0);

}  // namespace lamella
