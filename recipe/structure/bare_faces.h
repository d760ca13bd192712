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

/// Returns by element how deep it lies below a bare face: its depths (mm) from the nearest point of the face
/// to the farthest; both infinity for an element that is solid, whose nearest face is that of a solid
/// element or of one in `held` (1: an anchor or a load acts there, and holds the ends of cut beams), or that
/// is at least `most` deep.
std::vector<Interval> depths_below_faces(const Field& body, const ElementDomain& domain,
                                         std::span<const std::uint8_t> held, double most);

}  // namespace lamella
