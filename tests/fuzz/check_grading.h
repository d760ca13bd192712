// What fuzz targets ask of gradings that a file made.
#pragma once

#include <cmath>
#include <cstdlib>

#include "engine/base/geometry.h"
#include "engine/field/grading.h"

namespace lamella {

/// Aborts unless the range of a grading over a box (mm) encloses its numbers at some places of the box.
inline void check_grading(const Grading& grading, const Box& box) {
    const Interval range = grading.range(box);
    for (const dvec3 p : {box.lo, box.hi, box.center(), box.lo + box.size() * dvec3(0.1, 0.8, 0.3)}) {
        const double number = grading.at(p);
        if (std::isnan(number) ? range.hi != infinity : !range.contains(number)) std::abort();
    }
}

}  // namespace lamella
