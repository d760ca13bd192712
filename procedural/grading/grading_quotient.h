// The quotient of two gradings, to limit one length by another.
#pragma once

#include "engine/field/grading.h"

namespace lamella {

/// Returns numerator / denominator at every point. The denominator's range must be positive wherever it is
/// evaluated.
GradingPtr make_quotient_grading(GradingPtr numerator, GradingPtr denominator);

}  // namespace lamella
