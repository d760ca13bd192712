// Plans the supports of orientations, and looks for better ones near the best.
#pragma once

#include <functional>
#include <vector>

#include "recipe/placement/laid_part.h"
#include "recipe/placement/orient_part.h"

namespace lamella {

/// What the time of a plan depends on.
struct PlanCost {
    double surface = 0;         ///< of the body, mm^2
    double layer_height = 0.2;  ///< mm
    std::size_t triangles = 0;  ///< of the body's mesh
    bool is_sampled = false;    ///< sections are found by sampling, as those of formulas
};

/// Returns how many plans take some six seconds on two cores of 2020: at least 3, at most 60. Counts work,
/// not time.
std::size_t affordable_plans(const PlanCost& cost);

/// Returns the orientation of a direction to print along, without a plan.
using OrientationMeasure = std::function<Orientation(dvec3 up)>;

/// Plans the supports of at most `plans` orientations and sorts those before all others, by the material: of
/// the first in the list but hopeless ones, and with a third of the plans of neighbours of the best, in steps
/// from 4 degrees down to half of one. Neighbours are added to the list. Plans run side by side in the
/// caller's arena; the result is the same for any number of threads. Throws as LaidPart does.
void plan_orientations(const LaidPart& part, std::size_t plans, const OrientationMeasure& measure,
                       const OrientOptions& options, std::vector<Orientation>& list);

}  // namespace lamella
