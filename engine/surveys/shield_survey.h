// The shield survey: one pass over a job's layers, from which a wall is made that stands close to the print.
#pragma once

#include <memory>

#include "engine/layers/layer_stream.h"
#include "engine/runs/run_boxes.h"

namespace lamella {

/// Lengths in mm.
struct ShieldOptions : PassControl {
    double gap = 1;          ///< between the print and the shield in each layer, at least
    double wall = 0.9;       ///< thickness of the shield, at least
    double step = 0.225;     ///< by which its outline may move from layer to layer; sharp corners by 2.5
    double bead = 0.45;      ///< gaps narrower than twice this between its parts are closed
    double pitch = 0.1;      ///< from one surveyed row to the next; at most step * layers_at_once
    int layers_at_once = 1;  ///< that have the same shield, where layers are thin against the pitch
    std::size_t max_bytes = std::size_t{1} << 30;  ///< of memory for the plan
};

struct ShieldSurvey {
    std::shared_ptr<const RunBoxes> wall;  ///< the shield's boxes; never null
    double volume = 0;                     ///< mm^3
    int sweeps = 0;                        ///< over all layers until nothing changed
};

/// A wall about a job's part and supports, from its first layer to its last: the outermost `wall` mm of the
/// smallest solid that holds what is printed and the gap about it and whose outline moves by at most a step
/// from layer to layer (see printable_enclosure.h). Above what ends below the last layer it closes as a roof,
/// what is thinner than twice the wall is solid, and what is thinner than the wall is made as thick.
///
/// Rows are exact along x and stand for `pitch` in y. A pure function of (part, supports, layers, options),
/// the same by any number of threads. Memory is the plan's, which is of all layers: four bytes a row and
/// eight a run, and 56 a run while it becomes boxes. Throws InputError where an option makes no sense, where
/// the pitch is larger than a step or does not suit the job (survey_pitch_range), and where the plan needs
/// more than `max_bytes`; Interrupted when cancelled.
ShieldSurvey make_shield(const Job& job, const ShieldOptions& options);

}  // namespace lamella
