// Elements spread evenly, or by a density, where no loads place them.
#pragma once

#include "recipe/structure/element_grid.h"
#include "recipe/structure/place_elements.h"

namespace lamella {

/// Spreads elements over the body of the grid. Throws InputError for elements that overlap more than the
/// recipe allows, or of which most touch no other, Interrupted when cancelled.
ElementPlan spread_in_body(const Recipe& recipe, const Field& body, const ElementGrid& grid,
                           const std::vector<ElementShapePtr>& shapes, Gradings& gradings,
                           const PlaceElementsOptions& options);

/// Spreads elements over the body's surface, through a shell at most `depth` mm deep. Throws as
/// spread_in_body(), and as sites_on_surface().
ElementPlan spread_on_skin(const Recipe& recipe, const Field& body, const Field& shell, double depth,
                           Gradings& gradings, const PlaceElementsOptions& options);

}  // namespace lamella
