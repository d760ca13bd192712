// The quotient of two gradings: for limits on a length that are set by another length.
#pragma once

#include "engine/field/grading.h"

namespace lamella {

/// numerator / denominator at every point; the denominator's range is positive wherever it is asked for.
GradingPtr make_quotient_grading(GradingPtr numerator, GradingPtr denominator);

}  // namespace lamella
