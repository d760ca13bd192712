// Island survey: finds disconnected pieces of a job's part in one streaming pass over its layers.
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
    bool dropped = false;  ///< false if it is too large to be debris: reported, but kept
};

/// The findings of a survey.
struct IslandReport {
    std::size_t components = 0;   ///< components of the part, including islands
    std::size_t bodies = 0;       ///< components of the body that contain some of the part
    std::size_t count = 0;        ///< number of islands
    std::size_t too_large = 0;    ///< number of islands that are too large to be dropped
    double volume = 0;            ///< of all islands, mm^3
    double part_volume = 0;       ///< of the part, including islands, mm^3
    std::vector<Island> largest;  ///< the largest few, by falling volume
};

struct IslandSurveyOptions : PassControl {
    double pitch = 0.1;                           ///< mm from one surveyed row to the next
    std::size_t max_runs = std::size_t{1} << 17;  ///< most grown runs of an island that can be dropped
    std::size_t max_kept = std::size_t{1} << 24;  ///< most grown runs in memory; 16 bytes each
    std::size_t report_largest = 10;
};

struct IslandSurvey {
    IslandReport report;
    std::shared_ptr<const RunBoxes> dropped;  ///< never null
};

/// Surveys all layers of a job at their cutting planes: exact along x, with one row per `pitch` in y.
///
/// The part's runs are grown by a pitch in x, by a row in y and by a pitch's worth of layers in z. Grown runs
/// that touch are joined, so that pieces within two pitches of each other count as connected. To drop an
/// island means to subtract its grown runs; these stay a pitch away from everything that is kept. Features
/// thinner than a pitch that lie between two rows are missed.
///
/// The body's runs are joined where they touch, without growing, so that each of several bodies that stand
/// close together keeps its part. A component that lies in several components of the body is an island only
/// if it is the largest in none of them. Components outside the body form a group of their own; without a
/// body (null) all components do. Of equally large components the lowest counts as the largest.
///
/// The result is a pure function of (part, body, layers, pitch, max_runs), independent of the number of
/// threads. Memory depends on a few layers' runs and on the islands, not on the number of layers. Throws
/// InputError when the pitch does not suit the job or when the part falls into more pieces than `max_kept`
/// allows, Interrupted when cancelled.
IslandSurvey survey_islands(const Job& job, const FieldPtr& body, const IslandSurveyOptions& options);

}  // namespace lamella
