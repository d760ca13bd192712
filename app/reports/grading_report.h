// What the numbers that vary in space ask for over a part, and where it cannot be had.
#pragma once

#include <string>
#include <vector>

#include "recipe/build/build_job.h"

namespace lamella {

/// One graded number over the part's inside, by a lattice of points.
struct GradingReport {
    std::string key;   ///< "foam.cell"
    std::string unit;  ///< of the numbers and limits; empty where there is none
    Interval asked;    ///< empty where the number is nowhere defined
    Interval limits;
    double clamped = 0;    ///< share of the volume that asks for less or more than the limits
    double undefined = 0;  ///< share of the volume without a number, where the upper limit holds
    double steepest = 1;   ///< of cells: the greatest ratio of two cells that lie one cell apart
    dvec3 steepest_at{0};  ///< mm
};

/// Reports on the numbers that are formulas, in the order of the recipe's sections.
std::vector<GradingReport> grading_reports(const BuiltJob& built);

/// A sentence for each thing that is not as asked for: clamped, undefined, or steeper than cells can follow.
std::vector<std::string> warnings(const GradingReport& report);

}  // namespace lamella
