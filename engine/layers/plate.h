// Plates: arranges several jobs side by side, to be printed as one.
#pragma once

#include <span>
#include <vector>

#include "engine/layers/layer.h"

namespace lamella {

/// A job and its number of copies on the plate.
struct PlateItem {
    Job job;
    int copies = 1;
};

/// Returns one job with all parts side by side, their beds at one height. The parts stand in rows along x,
/// beginning at the lower left. The row length is chosen so that they take up the least share of the
/// machine's plate (`machine`: its size in x and y, mm; infinite if there is none, then the arrangement
/// becomes about square). `gap` is the distance between the bounds of neighbours, mm. The first part keeps
/// its place; a single part is returned as it is. Does not check whether all parts fit: the back-end does.
/// Throws InputError when layer heights differ or there are no parts.
Job arrange_plate(std::span<const PlateItem> items, double gap, dvec2 machine);

}  // namespace lamella
