// Infill: beads that fill the interior of a layer's islands.
#pragma once

#include "printers/polygons/polygons.h"
#include "printers/toolpath/bead.h"

namespace lamella {

/// Returns straight lines along `direction` (a unit vector) that fill a share `density` > 0 of a connected
/// region. All lines belong to one lattice of the plane, so that the lines of successive layers stand on each
/// other.
std::vector<Bead> sparse_lines(const Polygons& region, double density, dvec2 direction,
                               const LineSettings& line);

/// Returns straight lines that are evenly spread over a connected region, with the flow that gives the
/// region's volume.
std::vector<Bead> solid_lines(const Polygons& region, dvec2 direction, const LineSettings& line);

/// Returns nested loops that fill a share `density` of a region; at density 1 all of it.
std::vector<Bead> concentric_loops(const Polygons& region, double density, const LineSettings& line);

}  // namespace lamella
