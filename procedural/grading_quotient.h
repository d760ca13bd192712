// The quotient of two gradings: for limits on a length that are set by another length.
#pragma once

#include "engine/grading.h"

namespace lamella {

/// numerator / denominator at every point; the denominator's range is positive wherever it is asked for.
GradingPtr make_quotient_grading(GradingPtr numerator, GradingPtr denominator);

/// Encloses a length over the region as tight_range does. Throws InputError ("<what> ... mm; it must be
/// positive and finite") when it is not positive, not finite or not defined everywhere.
Interval positive_range(const Grading& length, const Box& region, const char* what);

}  // namespace lamella
