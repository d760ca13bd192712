// Quarter turns: a solid turned by right angles about the z axis, exactly.
#pragma once

#include "engine/field/field.h"

namespace lamella {

/// Returns the solid turned about the z axis by 90 degrees so many times, from x to y. Its slices are those
/// of the solid with their lines read the other way, so they are the same to the bit.
FieldPtr make_quarter_turn(FieldPtr solid, int quarters);

/// Returns the rectangle turned about the origin.
Rect quarter_turned(const Rect& rect, int quarters);

}  // namespace lamella
