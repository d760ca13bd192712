// Beads that fill the inside of a layer's islands.
#pragma once

#include "printers/polygons/polygons.h"
#include "printers/toolpath/bead.h"

namespace lamella {

/// Straight lines along `direction` (of unit length) that take a share of a connected region; one lattice for
/// the whole plane, so that the lines of one layer stand on those of another. `density` is more than 0.
std::vector<Bead> sparse_lines(const Polygons& region, double density, dvec2 direction,
                               const LineSettings& line);

/// Straight lines spread evenly over a connected region, with the flow that gives its volume.
std::vector<Bead> solid_lines(const Polygons& region, dvec2 direction, const LineSettings& line);

/// Loops within one another that take a share of a region; at density 1 all of it.
std::vector<Bead> concentric_loops(const Polygons& region, double density, const LineSettings& line);

}  // namespace lamella
