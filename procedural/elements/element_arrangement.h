// Elements arranged by hand or by another program, as an example of how others are to be spread.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "procedural/elements/placed_element.h"

namespace lamella {

/// Which elements an example may hold.
struct ArrangementLimits {
    std::uint32_t shapes = 1;  ///< numbers of shapes lie below
    Interval scales{1, 1};     ///< no scale lies outside
};

/// Reads elements as write_elements() writes them, one a line: shape,x,y,z,qw,qx,qy,qz,scale, places in mm.
/// The first line may name the columns; empty lines do not count. Quaternions get length 1. Throws InputError
/// ("name:line: ...") for a line that is no element, and for fewer than two elements or more than a million.
std::vector<PlacedElement> read_arrangement(std::string_view text, const std::string& name,
                                            const ArrangementLimits& limits);

/// Returns how much the distances of elements to their nearest neighbours vary: their standard deviation over
/// their mean. About 0.52 for places at random in a plane, 0 in a grid. At least two elements.
double spacing_variation(std::span<const PlacedElement> elements);

}  // namespace lamella
