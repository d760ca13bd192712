// Printable enclosures: tight enclosures of given layers whose outline can be printed as a wall.
#pragma once

#include "engine/layers/layer_stream.h"
#include "engine/layers/survey_rows.h"

namespace lamella {

/// Lengths in run units.
struct EnclosureRule {
    double step = run_unit;        ///< distance by which an outline may move between neighbouring layers
    double corner = 2 * run_unit;  ///< distance by which sharp corners may move; at least `step`
    double row_pitch = run_unit;   ///< from row to row; at most `step`
};

/// Grows the layers of a stack until each layer's outline is within a step of the outline of the layer below,
/// at sharp corners within `corner`. No layer shrinks. Two conditions hold afterwards:
/// - The erosion of a layer by a disc of radius `step` lies within the layers above and below it.
/// - No point of a layer is farther than `corner` and half a row from the layer below.
///
/// If straight sides are drawn in by a step, their corner moves by more: by 1.4 steps at a right angle, and
/// by still more at an acute one. Corners that stand out too far for the second condition are therefore drawn
/// in row by row, as far as needed. A piece connected to nothing else, such as the thin end of a feature that
/// began in the air, is continued down to the lowest layer.
///
/// Without such corners and pieces the result is the smallest possible one: then the first condition alone
/// decides, and the intersection of stacks that fulfil it fulfils it, too.
///
/// Sweeps down and up until nothing changes, and returns the number of sweeps. After Hornus, Lefebvre, Dumas
/// and Claux 2016; to keep thin features is ours. `cancel` may be null. Throws Interrupted when cancelled,
/// and InputError when the stack exceeds its memory limit.
int enclose(LayerStack& layers, const EnclosureRule& rule, const CancelToken* cancel);

}  // namespace lamella
