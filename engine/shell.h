// The shell of a solid: what lies within a distance of its surface.
#pragma once

#include "engine/field.h"

namespace lamella {

/// A field that, inside the body, is solid exactly where the surface is at most `thickness` mm away (true 3D
/// distance). Outside the body it may be solid too: intersect it with the body. InputError for a body without
/// a closed-form offset.
FieldPtr make_shell(const FieldPtr& body, double thickness);

}  // namespace lamella
