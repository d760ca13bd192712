// Gradings that turn with a part.
#pragma once

#include "engine/field/grading.h"

namespace lamella {

/// Returns the grading rotated or mirrored about the origin: at axes * p it has the number that the given one
/// has at p. `axes` is orthogonal. The identity returns the grading itself.
GradingPtr make_turned_grading(GradingPtr grading, const glm::dmat3& axes);

}  // namespace lamella
