// Shield survey: one pass over a job's layers that plans a wall around the print, close to it.
#pragma once

#include <memory>

#include "engine/layers/layer_stream.h"
#include "engine/runs/run_boxes.h"

namespace lamella {

/// Lengths in mm.
struct ShieldOptions : PassControl {
    double gap = 1;          ///< least distance between the print and the shield in each layer
    double wall = 0.9;       ///< least thickness of the shield
    double step = 0.225;     ///< distance by which its outline may move per layer; sharp corners by 2.5 steps
    double bead = 0.45;      ///< gaps between its parts that are narrower than twice this are closed
    double pitch = 0.1;      ///< from one surveyed row to the next; at most step * layers_at_once
    int layers_at_once = 1;  ///< number of layers with the same shield, for layers thinner than the pitch
    std::size_t max_bytes = std::size_t{1} << 30;  ///< most memory for the plan
};

struct ShieldSurvey {
    std::shared_ptr<const RunBoxes> wall;  ///< the shield's boxes; never null
    double volume = 0;                     ///< mm^3
    int sweeps = 0;                        ///< number of sweeps over all layers until nothing changed
};

/// Plans a wall around a job's part and supports, from the first layer to the last. The wall is the outermost
/// `wall` mm of an enclosure: the smallest solid that contains the print and the gap around it and whose
/// outline moves by at most a step from layer to layer (see printable_enclosure.h). Above features that end
/// below the last layer the wall closes as a roof. Where the enclosure is thinner than twice the wall it is
/// solid. Where it is thinner than the wall it is thickened to it.
///
/// Rows are exact along x and stand for `pitch` in y. A pure function of (part, supports, layers, options),
/// independent of the number of threads. Memory is that of the plan, which covers all layers: 4 bytes a row
/// and 8 a run, and 56 a run while it becomes boxes. Throws InputError when an option is out of range, when
/// the pitch exceeds a step or does not suit the job (survey_pitch_range), and when the plan needs more than
/// `max_bytes`; Interrupted when cancelled.
ShieldSurvey make_shield(const Job& job, const ShieldOptions& options);

}  // namespace lamella
