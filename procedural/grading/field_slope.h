// Rescales a field that is not a distance by its slope at the surface.
#pragma once

#include "engine/field/field.h"

namespace lamella {

/// Returns the maximum change per mm of the field's value at its surface, by central differences where the
/// edges of a lattice over the box (24 cells along its longest side) cross the surface; 1 if none does.
/// Throws InputError if the values jump there, because then no factor makes a distance of them.
double slope_at_surface(const Field& field, const Box& box);

/// Returns the same solid with its values divided by slope_at_surface. Near the surface its values are
/// roughly the distance where the field is steepest, and less elsewhere. The metric stays unchanged.
FieldPtr make_unit_slope(FieldPtr field, const Box& box);

}  // namespace lamella
