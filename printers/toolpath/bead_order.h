// In which order beads are printed, and where each begins.
#pragma once

#include <span>
#include <vector>

#include "printers/toolpath/bead.h"
#include "printers/toolpath/toolpath.h"

namespace lamella {

/// Appends beads to `out` by nearest neighbour from `at`, which moves along. Open ones are turned round where
/// that is nearer, loops begin where `seam` says.
void append_nearest(std::span<Bead> beads, Seam seam, dvec2& at, std::vector<Bead>& out);

/// An order in which points are visited from `start`: nearest neighbour, then made shorter by turning
/// stretches round (2-opt, among the eight nearest of each point) until nothing more is gained.
std::vector<std::size_t> short_tour(std::span<const dvec2> points, dvec2 start);

}  // namespace lamella
