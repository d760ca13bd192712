// Questions about where a solid is, answered by dividing boxes.
#pragma once

#include <optional>

#include "engine/field/field.h"

namespace lamella {

/// A point of the box (finite) that is in the solid; nothing where none is found. The box is divided where
/// the value at the centre, less half the diagonal, is least, and each division is followed down to a point,
/// towards lesser values; parts whose range proves them empty are left out. The search gives up after 20,000
/// parts: a solid that is small against the box, and whose values do not lead to it, may then be missed.
std::optional<dvec3> find_solid_point(const Field& solid, const Box& box);

}  // namespace lamella
