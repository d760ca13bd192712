// Several parts printed in one go: jobs side by side on a plate.
#pragma once

#include <span>
#include <vector>

#include "engine/layers/layer.h"

namespace lamella {

/// A job and how often it stands on the plate.
struct PlateItem {
    Job job;
    int copies = 1;
};

/// One job with all of the parts, their beds at one height, in rows along x from the lower left on, of the
/// length at which they take up least of the machine's plate (its size x, y in mm, infinite for none: the
/// plate becomes about square). `gap` lies between the bounds of neighbours, mm. The first part keeps its
/// place; a single one is returned as it is. Whether all fit is for the back-end to say. Throws InputError
/// when layer heights differ or there are no parts.
Job arrange_plate(std::span<const PlateItem> items, double gap, dvec2 machine);

}  // namespace lamella
