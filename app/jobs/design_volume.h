// The design of a search as a volume for a page.
#pragma once

#include <string>

#include "recipe/structure/optimize_part.h"

namespace lamella {

/// Returns a volume as coverage_volume() does, at most 128 voxels long, without supports: 128 at the surface
/// of a design of solid and void, more inside; of a foam more where it is denser than on average.
std::string design_volume(const SearchedDesign& design, bool is_foam);

/// Returns the volume of the design that a search ended with.
std::string design_volume(const OptimizedPart& part, bool is_foam);

}  // namespace lamella
