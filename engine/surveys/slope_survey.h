// Slope survey: how level the surface of a solid lies, by height.
#pragma once

#include <vector>

#include "engine/layers/layer_stream.h"

namespace lamella {

/// The slopes of a surface in slabs of equal height, from the bottom of a solid upward.
struct SlopeProfile {
    double step = 0;  ///< height of a slab, mm
    std::vector<double>
        flattest;  ///< by slab: the greatest |z| of the surface's unit normals; 0: upright or none
    std::vector<double> levels;  ///< heights of level faces over the bottom, mm; ascending

    /// Returns the greatest |z| of the normals between two heights over the bottom, without level faces.
    double flattest_in(double bottom, double top) const;
};

struct SlopeSurveyOptions : PassControl {
    double step = 0.05;  ///< height of a slab, mm
    double pitch = 0.5;  ///< of the rows in which the surface is looked for, along x and along y, mm
};

/// Surveys the surface of a solid within its bounds, slab by slab: where the sections below and above a slab
/// differ, the surface between them is found by bisection, and its normal by differences of the solid's
/// values. A face whose normal is upright, and which lies at one height, counts as level. Surfaces smaller
/// than a pitch may be missed. A pure function, independent of the number of threads. Memory: eight bytes a
/// slab. Throws Interrupted when cancelled.
SlopeProfile survey_slopes(const FieldPtr& solid, const Box& bounds, const SlopeSurveyOptions& options);

}  // namespace lamella
