// The hollow survey: one pass over a job's layers, from which cavities are made whose roofs print without
// supports.
#pragma once

#include <memory>

#include "engine/layers/layer_stream.h"
#include "engine/runs/run_boxes.h"

namespace lamella {

/// Lengths in mm.
struct HollowOptions : PassControl {
    double wall = 2;         ///< least thickness of what is left about a cavity, to all sides
    double step = 0.225;     ///< by which a layer may stand out over the one below
    double bead = 0.45;      ///< cavities are no narrower, and no walls between them thinner
    double chamber = 0;      ///< walls of a bead's width stand so far apart in x and y; 0: there are none
    double min_volume = 0;   ///< mm^3; smaller cavities are left solid
    double pitch = 0.1;      ///< from one surveyed row to the next; at most step * layers_at_once
    int layers_at_once = 1;  ///< that have the same cavity, where layers are thin against the pitch
    std::size_t max_bytes = std::size_t{1} << 30;  ///< of memory for the plan
};

struct HollowSurvey {
    std::shared_ptr<const RunBoxes> cavities;  ///< to be taken from the part; never null
    std::size_t count = 0;                     ///< cavities
    double volume = 0;                         ///< of them all, mm^3
    std::size_t left_solid = 0;                ///< those that were too small
    double part_volume = 0;                    ///< before they are taken, as surveyed, mm^3
};

/// Hollows out a job's part. A cavity lies at least `wall` inside the part, but for what of it lies between
/// the rows and cutting planes that are looked at; and, its roof apart, at most two diagonals of a pitch and
/// the layers taken at once further. What is solid over a cavity lies within a step of solid in the layer
/// below (see printable_roof.h); where layers are taken at once, so are their steps.
///
/// Rows are exact along x and stand for `pitch` in y: a cavity's walls are stairs of that width. Cavities are
/// closed; what prints from a bath of resin wants a hole in each.
///
/// A pure function of (part, layers, options), the same by any number of threads. Memory is the plan's, which
/// is of all layers: eight bytes a run and four a row of cavities, and 56 a run while it becomes boxes.
/// Throws InputError where an option makes no sense, where the pitch is larger than a step or does not suit
/// the job (survey_pitch_range), and where the plan needs more than `max_bytes`; Interrupted when cancelled.
HollowSurvey hollow_out(const Job& job, const HollowOptions& options);

}  // namespace lamella
