// The search for a plate that bears its loads and looks like a picture.
#pragma once

#include "recipe/structure/optimize_part.h"
#include "recipe/structure/part_design.h"

namespace lamella {

/// Finds the densities that look most like optimize.image among those within optimize.compliance times the
/// least compliance (see optimize_appearance), elements that a load touches being solid, and analyses the
/// shape cut from them. Throws as optimize_part() does, InputError for a picture that cannot be read or is
/// smaller than what is compared; Interrupted whenever it is cancelled, as designs of coarse grids are no
/// plates.
PartDesign pictured_plate(const Recipe& recipe, const Field& body, const BuiltRegions& regions,
                          Gradings& gradings, const OptimizeOptions& options);

}  // namespace lamella
