// The cavity survey: one streaming pass over a job's layers that finds the void that is closed off.
#pragma once

#include <vector>

#include "engine/layers/layer_stream.h"

namespace lamella {

/// A part of the void that no way leads out of.
struct Cavity {
    double volume = 0;  ///< mm^3, as surveyed
    dvec3 lowest{0};    ///< a point of its lowest layer, about in the middle of what lies there, mm
    dvec3 highest{0};   ///< the same of its highest layer
};

struct CavitySurveyOptions : PassControl {
    double pitch = 0.1;       ///< mm from one surveyed row to the next
    std::size_t most = 1000;  ///< cavities that are told of
};

struct CavitySurvey {
    std::size_t count = 0;
    double volume = 0;             ///< of all, mm^3
    std::vector<Cavity> cavities;  ///< the `most` largest, by falling volume; of equals the lowest first
};

/// Surveys all layers of a job at their cutting planes: exact along x, a row each `pitch` across. Runs of
/// void that overlap or touch, in neighbouring rows and layers, corners included, are one. Walls thinner than
/// a pitch may be missed, and what they close off then counts as open. What lies beside, below and above the
/// job's bounds is outside.
///
/// A pure function of (part, layers, pitch), the same by any number of threads. Memory depends on a few
/// layers' runs and on the number of places where void begins. Throws InputError when the pitch does not suit
/// the job (survey_pitch_range says which do), Interrupted when cancelled.
CavitySurvey survey_cavities(const Job& job, const CavitySurveyOptions& options);

}  // namespace lamella
