// Order in which beads are printed, and where each begins.
#pragma once

#include <span>
#include <vector>

#include "printers/toolpath/bead.h"
#include "printers/toolpath/toolpath.h"

namespace lamella {

/// Appends beads to `out` in nearest-neighbour order, starting from `at`, which is updated. Open beads are
/// reversed if that is nearer; loops begin according to `seam`.
void append_nearest(std::span<Bead> beads, Seam seam, dvec2& at, std::vector<Bead>& out);

/// Returns an order in which to visit points from `start`: nearest neighbour, then improved by 2-opt
/// (reversing stretches, among the eight nearest neighbours of each point) until nothing more is gained.
std::vector<std::size_t> short_tour(std::span<const dvec2> points, dvec2 start);

}  // namespace lamella
