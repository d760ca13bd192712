// The island survey: one streaming pass over a job's layers that finds what floats free of the part.
#pragma once

#include <memory>
#include <vector>

#include "engine/layers/layer_stream.h"
#include "engine/runs/run_boxes.h"

namespace lamella {

/// A component of the part that is not the largest in its component of the body.
struct Island {
    double volume = 0;    ///< mm^3, as surveyed
    Box box;              ///< mm, as surveyed
    int first_layer = 0;  ///< [first_layer, end_layer)
    int end_layer = 0;
    bool dropped = false;  ///< false for one that is too large to be debris: it is reported, and left alone
};

/// What a survey found.
struct IslandReport {
    std::size_t components = 0;   ///< of the part, islands included
    std::size_t bodies = 0;       ///< components of the body that hold some of the part
    std::size_t count = 0;        ///< islands
    std::size_t too_large = 0;    ///< ... of which too large to be dropped
    double volume = 0;            ///< of all islands, mm^3
    double part_volume = 0;       ///< of the part, islands included, mm^3
    std::vector<Island> largest;  ///< the largest few, by falling volume
};

struct IslandSurveyOptions : PassControl {
    double pitch = 0.1;                           ///< mm from one surveyed row to the next
    std::size_t max_runs = std::size_t{1} << 17;  ///< grown runs of an island that can still be dropped
    std::size_t max_kept = std::size_t{1} << 24;  ///< grown runs kept in all; 16 bytes each
    std::size_t report_largest = 10;
};

struct IslandSurvey {
    IslandReport report;
    std::shared_ptr<const RunBoxes> dropped;  ///< never null
};

/// Surveys all layers of a job at their cutting planes: exact along x, a row each `pitch` across.
///
/// The part's runs are grown by a pitch in x, by a row in y and by a pitch's worth of layers in z, and grown
/// runs that touch are joined: what lies within two pitches counts as connected. The plan to drop an island
/// is its grown runs, so it stays a pitch away from everything that is kept. What is thinner than a pitch
/// between two rows is not seen. The body's runs are joined where they touch, without growing, so that bodies
/// that stand close together each keep their part. A component within several components of the body is an
/// island only when it is the largest in none; components outside the body are taken together as if in one of
/// their own; without a body (null) so is everything. Of equals, the lowest is the largest.
///
/// The result is a pure function of (part, body, layers, pitch, max_runs), the same by any number of
/// threads. Memory depends on a few layers' runs and on the islands, not on the number of layers. Throws
/// InputError when the pitch does not suit the job or when the part falls into more pieces than `max_kept`
/// has room for, Interrupted when cancelled.
IslandSurvey survey_islands(const Job& job, const FieldPtr& body, const IslandSurveyOptions& options);

}  // namespace lamella
