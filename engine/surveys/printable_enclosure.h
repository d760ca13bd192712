// Tight printable enclosures: what holds given layers and has an outline that can be printed as a wall.
#pragma once

#include "engine/layers/layer_stream.h"
#include "engine/layers/survey_rows.h"

namespace lamella {

/// Lengths in run units.
struct EnclosureRule {
    double step = run_unit;        ///< by which a layer may be drawn in against its neighbours
    double corner = 2 * run_unit;  ///< by which sharp corners of it may; at least the step
    double row_pitch = run_unit;   ///< from row to row; at most the step
};

/// Grows the layers of a stack, none of which shrinks, until each layer's outline lies within a step of the
/// outline of the layer below, at sharp corners within `corner`:
/// - what a disc of radius `step` leaves of a layer, when one stands about each point outside it, lies in the
///   layers above and below it;
/// - nothing of a layer lies further than `corner` and half a row from the layer below. Where straight sides
/// are
///   drawn in by a step, their corner moves by more, 1.4 steps where it is a right angle, and still more
///   where it is acute; what that leaves behind comes in row by row as far as is needed, and what hangs
///   together with nothing else, such as the thin end of what began in the air, goes down to the lowest
///   layer.
///
/// Without such things the result is the smallest that holds this, for the first condition alone decides it,
/// and what several stacks hold that fulfil it, does so, too. Sweeps down and up until nothing changes;
/// returns their number. Hornus, Lefebvre, Dumas and Claux 2016; keeping what is thin is ours. Throws
/// Interrupted when cancelled (may be null), and InputError where the stack has no room.
int enclose(LayerStack& layers, const EnclosureRule& rule, const CancelToken* cancel);

}  // namespace lamella
