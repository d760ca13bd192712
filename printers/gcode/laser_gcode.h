// Back-end: G-code for GRBL 1.1 lasers that cut layers out of sheets.
#pragma once

#include <memory>

#include "engine/layers/backend.h"
#include "printers/common/profile.h"
#include "printers/gcode/gcode_output.h"

namespace lamella {

/// Makes a back-end that writes a section for each layer that is not empty: its cuts in the order of
/// plan_cuts, with S0 on every G0, so that the beam is off between cuts with and without $32 = 1. Before each
/// section but the first the machine waits (M0) for the next sheet, unless the profile has a layer_script.
/// The lower left corner of the part's bounds, grown by half the kerf, lies at the origin. No line is longer
/// than 79 bytes; comments are on their own lines.
///
/// begin throws InputError for an invalid profile, for supports, for several layers on one sheet, and for a
/// part that is larger than the bed.
std::unique_ptr<Backend> make_laser_gcode(const PrinterProfile& profile, std::unique_ptr<GcodeOutput> output);

/// Returns the largest size of a part, mm: the bed less the kerf; the height is unlimited.
dvec3 laser_build_volume(const PrinterProfile& profile);

}  // namespace lamella
