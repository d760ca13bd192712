// Making distances of values that are none: by the slope that they have at the surface.
#pragma once

#include "engine/field/field.h"

namespace lamella {

/// The greatest change per mm of the field's value at its surface, by central differences where the edges of
/// a lattice over the box (24 cells along its longest side) pass through the surface; 1 where they never do.
/// InputError where the values jump there: no slope makes a distance of them.
double slope_at_surface(const Field& field, const Box& box);

/// The same solid with its values divided by slope_at_surface: near the surface they are about the distance
/// where the field is steepest, and less elsewhere. Its metric stays what it is.
FieldPtr make_unit_slope(FieldPtr field, const Box& box);

}  // namespace lamella
