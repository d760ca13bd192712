// The shell of a solid: what lies within a distance of its surface, and solids made of a shell and a filling.
#pragma once

#include "engine/field.h"

namespace lamella {

/// A field that, inside the body, is solid exactly where the surface is at most `thickness` mm away (true 3D
/// distance). Outside the body it may be solid too: intersect it with the body. InputError for a body without
/// a closed-form offset.
FieldPtr make_shell(const FieldPtr& body, double thickness);

/// The body filled: its part that is in the filling or within `thickness` mm of its surface. The filling may
/// be null (a hollow body), the thickness 0 (no skin); not both.
FieldPtr make_filled_body(FieldPtr body, FieldPtr filling, double thickness);

}  // namespace lamella
