// Cavity survey: finds closed cavities of a job's part in one streaming pass over its layers.
#pragma once

#include <vector>

#include "engine/layers/layer_stream.h"

namespace lamella {

/// A connected part of the void without a way out.
struct Cavity {
    double volume = 0;  ///< mm^3, as surveyed
    dvec3 lowest{0};    ///< a point of its lowest layer, about in the middle of the cavity's runs there, mm
    dvec3 highest{0};   ///< such a point of its highest layer, mm
};

struct CavitySurveyOptions : PassControl {
    double pitch = 0.1;       ///< mm from one surveyed row to the next
    std::size_t most = 1000;  ///< most cavities to report
};

struct CavitySurvey {
    std::size_t count = 0;         ///< number of cavities
    double volume = 0;             ///< of all cavities, mm^3
    std::vector<Cavity> cavities;  ///< the `most` largest, by falling volume; of equals the lowest first
};

/// Surveys all layers of a job at their cutting planes: exact along x, with one row per `pitch` in y. Runs of
/// void that overlap or touch, in neighbouring rows and layers, corners included, are connected. Walls
/// thinner than a pitch may be missed; the cavities that they close off then count as open. Everything
/// beside, below and above the job's bounds is outside.
///
/// A pure function of (part, layers, pitch), independent of the number of threads. Memory depends on a few
/// layers' runs and on the number of places where void begins. Throws InputError when the pitch does not suit
/// the job (see survey_pitch_range), Interrupted when cancelled.
CavitySurvey survey_cavities(const Job& job, const CavitySurveyOptions& options);

}  // namespace lamella
