// PlatedJob: the parts of a print on their plates.
#pragma once

#include <span>

#include "engine/layers/plate.h"
#include "recipe/recipe.h"

namespace lamella {

struct PlatedJob {
    Job job;         ///< of the plate that was asked for
    int plates = 1;  ///< that the parts need
};

/// Arranges parts on plates of the recipe's machine, as [plate] says, with a purge tower where a machine that
/// lays beads needs one, or a single part at part.at. Throws InputError where a part is
/// larger than the plate, or there are fewer plates than plate.number.
PlatedJob put_on_plates(const Recipe& recipe, std::span<const PlateItem> items, const PassControl& control);

}  // namespace lamella
