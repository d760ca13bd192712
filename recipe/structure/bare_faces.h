// Depths below faces of a foam that neither a skin nor a frame covers.
#pragma once

#include <span>
#include <vector>

#include "recipe/structure/element_domain.h"

namespace lamella {

struct Recipe;

/// Returns true for a foam without a skin or a frame.
bool has_bare_faces(const Recipe& recipe);
/// Returns true for a foam that is soft below its bare faces as cut_cells_share() says.
bool softens_at_faces(const Recipe& recipe);

/// Returns by element its range of depths (mm) below a bare face. In the plane an element reaches from the
/// middle of the plate to its face, if that is the nearest. Both are infinity for an element that is solid,
/// that is deeper than `most` (mm), or whose nearest face is covered: by a solid element or by one in `held`
/// (1: an anchor or a load acts there, and holds the ends of cut beams).
std::vector<Interval> depths_below_faces(const Field& body, const ElementDomain& domain,
                                         std::span<const std::uint8_t> held, double most);

}  // namespace lamella
