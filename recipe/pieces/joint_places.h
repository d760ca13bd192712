// Places of the pins or dowels that join two pieces of a part.
#pragma once

#include <vector>

#include "engine/field/field.h"
#include "recipe/pieces/cut_recipe.h"

namespace lamella {

/// The plane of all points p with dot(p, normal) = offset; `normal` is a unit vector.
struct CutPlane {
    dvec3 normal{0, 0, 1};
    double offset = 0;  ///< mm
};

/// Returns the middles of the joints in the plane: as far apart as there is room for in `solid`, so that
/// holes on both sides keep their walls, and so that the pieces fit in one way only (dowel_places.h). `solid`
/// is what both pieces are cut from. Throws InputError, naming the cut, where there is no room.
std::vector<dvec3> joint_places(const FieldPtr& solid, const CutPlane& plane, const CutRecipe& cut);

}  // namespace lamella
