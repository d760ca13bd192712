// Statistics of a graded foam over a box: seeds, sizes and volume fraction, by sums over a lattice.
#pragma once

#include "recipe/build/build_foam.h"

namespace lamella {

struct FoamStatistics {
    double seeds = 0;            ///< expected number in the box: one per cubed cell size
    double densest_plane = 0;    ///< seeds per mm^3, averaged over the plane z = const with the most seeds
    double greatest_cell = 0;    ///< mm
    double mean_member = 0;      ///< mm
    double volume_fraction = 0;  ///< NaN when no law is known
};

/// Sums over the centres of a lattice of cubes, `per_side` along the longest side; exact for uniform foams.
FoamStatistics foam_statistics(const BuiltFoam& foam, const Box& box, int per_side = 24);

}  // namespace lamella
