// Order in which beads are printed, and where each begins.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "printers/toolpath/bead.h"
#include "printers/toolpath/toolpath.h"

namespace lamella {

/// Appends beads to `out` in nearest-neighbour order, starting from `at`, which is updated. Open beads are
/// reversed if that is nearer; loops begin according to `seam`.
void append_nearest(std::span<Bead> beads, Seam seam, dvec2& at, std::vector<Bead>& out);

/// Returns where the nozzle is once a bead is laid: a loop ends where it begins.
dvec2 end_of(const Bead& bead);
/// Makes a loop begin at one of its points.
void begin_at(Bead& loop, std::size_t point);

/// Cost of an edge between two points of a tour, the same in both directions; the number of points stands for
/// the start.
using TourCost = std::function<double(std::size_t, std::size_t)>;

/// Returns an order in which to visit points from `start`: the nearest each time, then improved by 2-opt
/// (reversing stretches, among the eight nearest neighbours of each point) and by moving single points, until
/// nothing more is gained by the cost of its edges; without a cost by its length.
std::vector<std::size_t> short_tour(std::span<const dvec2> points, dvec2 start, const TourCost& cost = {});

}  // namespace lamella
