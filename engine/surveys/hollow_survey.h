// Hollow survey: one pass over a job's layers that plans cavities whose roofs print without supports.
#pragma once

#include <memory>

#include "engine/layers/layer_stream.h"
#include "engine/runs/run_boxes.h"

namespace lamella {

/// Lengths in mm.
struct HollowOptions : PassControl {
    double wall = 2;         ///< least thickness of the solid around a cavity, to all sides
    double step = 0.225;     ///< distance by which a layer may stand out over the one below
    double bead = 0.45;      ///< least width of cavities and of the walls between them
    double chamber = 0;      ///< distance in x and y between walls of a bead's width; 0: no such walls
    double min_volume = 0;   ///< mm^3; smaller cavities are left solid
    double pitch = 0.1;      ///< from one surveyed row to the next; at most step * layers_at_once
    int layers_at_once = 1;  ///< number of layers with the same cavity, for layers thinner than the pitch
    std::size_t max_bytes = std::size_t{1} << 30;  ///< most memory for the plan
};

struct HollowSurvey {
    std::shared_ptr<const RunBoxes> cavities;  ///< to be subtracted from the part; never null
    std::size_t count = 0;                     ///< number of cavities
    double volume = 0;                         ///< of all cavities, mm^3
    std::size_t left_solid = 0;                ///< number of cavities that were too small
    double part_volume = 0;                    ///< of the part before hollowing, as surveyed, mm^3
};

/// Plans cavities that hollow out a job's part. A cavity is at least `wall` away from the part's surface, as
/// far as the surveyed rows and cutting planes show it. Apart from its roof, the distance exceeds `wall` by
/// at most two diagonals of a pitch and a group of layers_at_once layers. Solid above a cavity lies within a
/// step of solid in the layer below (see printable_roof.h). For groups of layers, steps are per group and
/// that much larger.
///
/// Rows are exact along x and stand for `pitch` in y: a cavity's walls are stairs of that width. Cavities are
/// closed. A part printed from a bath of resin needs a hole into each.
///
/// A pure function of (part, layers, options), independent of the number of threads. Memory is that of the
/// plan, which covers all layers: 8 bytes a run and 4 a row of cavities, and 56 a run while it becomes boxes.
/// Throws InputError when an option is out of range, when the pitch exceeds a step or does not suit the job
/// (survey_pitch_range), and when the plan needs more than `max_bytes`; Interrupted when cancelled.
HollowSurvey hollow_out(const Job& job, const HollowOptions& options);

}  // namespace lamella
