// Back-end: G-code for lasers under GRBL 1.1 that cut layers out of sheets.
#pragma once

#include <memory>

#include "engine/layers/backend.h"
#include "printers/common/profile.h"
#include "printers/gcode/gcode_output.h"

namespace lamella {

/// Writes a section for each layer that is not empty: its cuts as plan_cuts orders them, with S0 on every G0,
/// so that the beam is off between cuts with $32 = 1 and without. Before each section but the first the
/// machine waits (M0) for the next sheet, unless the profile has a layer_script. The part's bounds, grown by
/// half the kerf, lie with their lower left corner at the origin. No line is longer than 79 bytes; comments
/// are lines of their own.
///
/// begin throws InputError for a profile that makes no sense, for supports, for layers on shared sheets, and
/// for a part that is larger than the bed.
std::unique_ptr<Backend> make_laser_gcode(const PrinterProfile& profile, std::unique_ptr<GcodeOutput> output);

/// What the bed has room for beside the kerf, mm; upward there is no end.
dvec3 laser_build_volume(const PrinterProfile& profile);

}  // namespace lamella
