// From body, foam and skin to the part.
#pragma once

#include "recipe/build/build_job.h"

namespace lamella {

/// Returns the body filled with the foam that was built and under the recipe's skin, or the body itself where
/// the recipe asks for neither. Stores thickness, windows, holes and drains of the skin in `built`. Throws
/// InputError for a body that cannot have such a skin, and for holes that do not fit, Interrupted when the
/// work is cancelled.
FieldPtr fill_body(const Recipe& recipe, BuiltJob& built, Gradings& gradings, const PatternWork& work);

}  // namespace lamella
