// How the part is mirrored, laid on a face, turned and scaled before it is printed.
#pragma once

#include "engine/field/field.h"
#include "recipe/recipe.h"

namespace lamella {

/// Returns the orthogonal axes that the part is turned by about its origin: mirrored first, then laid on a
/// face, then turned. Throws InputError for a direction that is not finite.
glm::dmat3 part_axes(const PartRecipe& part);

/// Returns the recipe with the point of a face (`lay_on_at`) replaced by that face's direction, and the box
/// to fit by a scale. Throws InputError where the body cannot be made, or no point of its surface is nearest
/// to that point.
Recipe with_known_placement(const Recipe& recipe);

/// Returns the bounds of a body within its bounds, which are loose once a sampled body is turned: each side
/// is moved inward, to a millionth of the box, as far as find_solid_point() finds nothing beyond;
/// the body's own where it finds nothing at all.
Box tight_bounds(const Field& body);

/// Returns the part's recipe as it was designed: not turned, mirrored or laid on a face.
PartRecipe not_turned(PartRecipe part);

}  // namespace lamella
