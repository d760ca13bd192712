// Reports on graded numbers over a part, and on values that cannot be made.
#pragma once

#include <string>
#include <vector>

#include "recipe/build/build_job.h"

namespace lamella {

/// Statistics of one graded number inside the part, sampled on a lattice of points.
struct GradingReport {
    std::string key;   ///< "foam.cell"
    std::string unit;  ///< of the numbers and limits; empty for none
    Interval asked;    ///< empty when the number is undefined everywhere
    Interval limits;
    double clamped = 0;    ///< share of the volume where the requested number is outside the limits
    double undefined = 0;  ///< share of the volume where the number is undefined, so that the upper limit is
                           ///< used
    double steepest = 1;   ///< of cells: the greatest ratio of two cell sizes one cell apart
    dvec3 steepest_at{0};  ///< mm
};

/// Reports on the numbers that are formulas, in the order of the recipe's sections.
std::vector<GradingReport> grading_reports(const BuiltJob& built);

/// Returns a sentence for each deviation from the request: clamped, undefined, or steeper than cells can
/// follow.
std::vector<std::string> warnings(const GradingReport& report);

}  // namespace lamella
