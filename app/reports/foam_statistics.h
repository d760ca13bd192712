// What a graded foam amounts to over a box: seeds, sizes and solid share, by sums over a lattice.
#pragma once

#include "recipe/build/build_foam.h"

namespace lamella {

struct FoamStatistics {
    double seeds = 0;            ///< expected in the box: one to every cell cubed
    double densest_plane = 0;    ///< seeds per mm^3, on average over the plane z = const that has most
    double greatest_cell = 0;    ///< mm
    double mean_member = 0;      ///< mm
    double volume_fraction = 0;  ///< NaN where no law is known
};

/// Sums over the centres of a lattice of cubes, `per_side` along the longest side; exact where nothing
/// varies.
FoamStatistics foam_statistics(const BuiltFoam& foam, const Box& box, int per_side = 24);

}  // namespace lamella
