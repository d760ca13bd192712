// The search for the stiffest shape, or foam, of a part.
#pragma once

#include "recipe/structure/optimize_part.h"
#include "recipe/structure/part_design.h"

namespace lamella {

/// Finds the densities of least compliance within the volume, and analyses the shape cut from them. `search`
/// is the file of a search that is cancelled, from which it goes on if options say so; empty: none is kept.
/// Throws as optimize_part() does.
PartDesign stiffest_part(const Recipe& recipe, const Field& body, const BuiltRegions& regions,
                         Gradings& gradings, const OptimizeOptions& options,
                         const std::filesystem::path& search);

}  // namespace lamella
