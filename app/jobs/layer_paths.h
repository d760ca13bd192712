// The moves of a layer, as the G-code file has them.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "app/jobs/served_job.h"

namespace lamella {

/// Whether a machine lays beads of filament; a laser under GRBL does not.
bool lays_beads(const PrinterProfile& printer);

/// Returns what a machine that lays beads does in a layer, in the order of printing; mm, mm/s, s:
///
///     {"paths": [{"role", "tool", "width", "speed", "closed", "points": [x, y, ...], "widths", "speeds"}],
///      "travels": [{"after", "speed", "retracts", "points", "speeds"}], "seconds", "z"}
///
/// Moves are those that the back-end writes, slowed down as there; arcs are chords within half the tolerance.
/// "width" and "speed" are the greatest of a path; "widths" and "speeds" have one for each of its segments,
/// where they vary. A travel comes after so many paths; it includes wipes. The way to the layer's first path
/// is left out, as it depends on the layers before; of several tools, the layer's first is in use before.
/// Throws HttpError 400 for other machines, Interrupted when cancelled.
nlohmann::ordered_json layer_paths(const ServedJob& job, int layer, const CancelToken* cancel);

}  // namespace lamella
