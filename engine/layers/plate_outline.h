// PlateOutline: what a job covers on its plate.
#pragma once

#include "engine/layers/layer_stream.h"

namespace lamella {

/// What part and supports of a job cover, seen from above: rows and columns of square pixels. Rows along x
/// are lines of the plane, from the lowest y on; columns along y from the lowest x on.
struct PlateOutline {
    dvec2 origin{0};   ///< of run coordinate 0 and line 0, mm
    double pitch = 0;  ///< mm
    RunRows rows, columns;

    /// Returns the rows of the outline turned by so many right angles, from x to y. They begin at its own
    /// lower left corner.
    RunRows turned(int quarters) const;
};

/// Surveys all layers of a job. Rows and columns cut the outline exactly; what lies between two of them may
/// be missed. Throws Interrupted when cancelled.
PlateOutline survey_outline(const Job& job, double pitch, const PassControl& control);

}  // namespace lamella
