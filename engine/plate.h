// Several parts printed in one go: jobs side by side on a plate.
#pragma once

#include <span>
#include <vector>

#include "engine/layer.h"

namespace lamella {

/// A job and how often it stands on the plate.
struct PlateItem {
    Job job;
    int copies = 1;
};

/// One job with all of the parts, their beds at one height, in rows along x from the lower left on: a row
/// ends where it would become longer than the square root of the plate's area asks for, or than `width` (mm).
/// `gap` lies between the bounds of neighbours, mm. The first part keeps its place, so that a single one is
/// returned as it is. Throws InputError when layer heights differ or there are no parts.
Job arrange_plate(std::span<const PlateItem> items, double gap, double width);

}  // namespace lamella
