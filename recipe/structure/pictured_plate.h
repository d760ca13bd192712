// The search for a plate that bears its loads and looks like a picture.
#pragma once

#include "recipe/structure/optimize_part.h"
#include "recipe/structure/part_design.h"

namespace lamella {

/// Finds the densities that look most like optimize.image among those within optimize.compliance times the
/// least compliance (see AppearanceOptimizer), elements that a load touches being solid, and analyses the
/// shape cut from them. `search` is the file of a search that is cancelled, from which it goes on if options
/// say so; empty: none is kept. A search that is cancelled shows its last design, on the finest grid, or the
/// stiffest plate as long as that is far too soft. Throws as optimize_part() does, InputError for a
/// picture that cannot be read or is smaller than what is compared, and Interrupted when cancelled before the
/// stiffest plate of the coarsest grid is found.
PartDesign pictured_plate(const Recipe& recipe, const Field& body, const BuiltRegions& regions,
                          Gradings& gradings, const OptimizeOptions& options,
                          const std::filesystem::path& search);

}  // namespace lamella
