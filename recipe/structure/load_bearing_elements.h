// Elements placed such that together they bear the recipe's loads.
#pragma once

#include "recipe/structure/element_grid.h"
#include "recipe/structure/place_elements.h"

namespace lamella {

/// Places elements in the body of the grid; the search ends on a finer one if that is not too large. Throws
/// InputError and Interrupted as place_elements() does.
ElementPlan load_bearing_elements(const Recipe& recipe, const Field& body, const BuiltRegions& regions,
                                  ElementGrid grid, const std::vector<ElementShapePtr>& shapes,
                                  Gradings& gradings, const PlaceElementsOptions& options);

}  // namespace lamella
