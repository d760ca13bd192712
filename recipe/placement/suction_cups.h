// The suction cups of a body that stands on the bed.
#pragma once

#include "engine/field/field.h"
#include "engine/layers/layer_stream.h"

namespace lamella {

/// Returns the volume of the body's suction cups of at least `least` mm^3 each, by the print check: mm^3.
/// Looks at layers of `layer_height` mm, or at 200 thicker ones, in rows a 200th of the body's width apart.
/// Throws Interrupted when cancelled.
double cup_volume(const FieldPtr& body, double layer_height, double least, const PassControl& control);

}  // namespace lamella
