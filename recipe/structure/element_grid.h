// The grid on which elements are placed, and what joins them.
#pragma once

#include <optional>
#include <vector>

#include "procedural/elements/element_pieces.h"
#include "procedural/elements/element_raster.h"
#include "recipe/structure/element_domain.h"

namespace lamella {

/// The cells of a body in which elements are placed, and their shapes.
struct ElementGrid {
    ElementDomain domain;
    CellGrid cells;
    std::vector<DistanceTable> tables;  ///< of the shapes, as far as the smooth border of an element reaches

    bool is_flat() const { return cells.is_flat; }
};

/// Returns the shapes as tables, with `margin` mm around them.
std::vector<DistanceTable> element_tables(std::span<const ElementShapePtr> shapes, double margin,
                                          bool is_flat);

/// Returns the thickness of the thinnest copy, mm.
double thinnest_of(const ElementsRecipe& elements, std::span<const DistanceTable> tables);

/// Throws InputError for shapes that are larger than a part with these bounds.
void check_element_sizes(const Recipe& recipe, std::span<const DistanceTable> tables, const Box& bounds);

/// Divides the body into cells that suit the recipe's elements, of at least `least_edge` mm unless the recipe
/// states their edge. Throws InputError for shapes that are larger than the body or too thin for such cells,
/// and as element_domain() does.
ElementGrid element_grid(const Recipe& recipe, const Field& body, const BuiltRegions& regions,
                         std::span<const ElementShapePtr> shapes, double least_edge,
                         const CancelToken* cancel);

/// Returns cells half as wide, on which a search is to end; none where there would be too many.
std::optional<ElementGrid> finer_element_grid(const Recipe& recipe, const Field& body,
                                              const BuiltRegions& regions,
                                              std::span<const ElementShapePtr> shapes,
                                              const ElementGrid& grid, const CancelToken* cancel);

/// Returns how placed elements are made one piece with each other and with the grid's solid regions.
JoinSettings join_settings(const ElementsRecipe& recipe, const ElementGrid& grid, const Field& body,
                           std::span<const PlacedElement> elements);

/// Joins elements as the settings say. Throws InputError if solid regions stand apart then.
JoinedElements joined_elements(std::vector<PlacedElement> elements, std::span<const double> loads,
                               std::span<const ElementShapePtr> shapes, const JoinSettings& settings);

}  // namespace lamella
