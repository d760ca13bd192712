// Bounds of a solid, found from its sections.
#pragma once

#include "engine/field/field.h"

namespace lamella {

/// Returns close bounds of a solid within its own, which a cut may have left loose: what 200 sections cover
/// in x and y, and a little more, and the heights at which sections begin and end, to a thousandth of a
/// millimetre. Sides that come so near to the solid's own bounds are those. Empty where no section has
/// anything.
Box section_bounds(const Field& solid);

}  // namespace lamella
