// Back-end: G-code for filament printers with one extruder, and for lasers (laser_gcode.h).
#pragma once

#include <memory>
#include <string>

#include "engine/layers/backend.h"
#include "printers/common/profile.h"
#include "printers/gcode/gcode_output.h"

namespace lamella {

/// Writes a G-code file: absolute millimetres, relative extrusion, the part's bounds centred on the bed,
/// comments that previewers of the Slic3r family read. What a layer's lines are depends on the layer alone,
/// but for the travel to its first bead, with what is drawn back and wiped before it.
/// Toolpaths: see plan_toolpaths; ways between beads: see BeadTravel. Islands too small for any bead are
/// counted in the file's last lines, as are filament and time by the motion model. No line is longer than 95
/// characters. What the words of a firmware are: see gcode_flavour.h.
///
/// begin throws InputError for a profile that makes no sense and for a part that does not fit the bed less a
/// strip round it for the priming line.
/// Where the flavour is grbl, make_laser_gcode makes the back-end.
std::unique_ptr<Backend> make_gcode(const PrinterProfile& profile, const std::string& path, bool force);
/// The same to any other place.
std::unique_ptr<Backend> make_gcode(const PrinterProfile& profile, std::unique_ptr<GcodeOutput> output);

/// What the bed has room for beside the strip for the priming line, brim and skirt, and how high, mm; under
/// grbl laser_build_volume.
dvec3 gcode_build_volume(const PrinterProfile& profile, double layer_height);

}  // namespace lamella
