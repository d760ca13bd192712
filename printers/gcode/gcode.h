// Back-end: G-code for filament printers, and for lasers (laser_gcode.h).
#pragma once

#include <memory>
#include <string>

#include "engine/layers/backend.h"
#include "printers/common/profile.h"
#include "printers/gcode/gcode_output.h"

namespace lamella {

/// Makes a back-end that writes a G-code file: absolute millimetres, relative extrusion, the part's bounds
/// centred on the bed, comments for previewers of the Slic3r family. The lines of a layer depend on that
/// layer alone, except for the travel to its first bead and the retraction and wipe before it. For toolpaths
/// see plan_toolpaths; for travel between beads see BeadTravel. The last lines of the file state the number
/// of islands too small for any bead, the filament used, and the print time by the motion model. No line is
/// longer than 95 characters. For the dialects of firmware see gcode_flavour.h.
///
/// begin throws InputError for an invalid profile and for a part that does not fit the bed less the strip for
/// the priming line. For the flavour grbl make_laser_gcode makes the back-end.
std::unique_ptr<Backend> make_gcode(const PrinterProfile& profile, const std::string& path, bool force);
/// Makes the same back-end for any other output.
std::unique_ptr<Backend> make_gcode(const PrinterProfile& profile, std::unique_ptr<GcodeOutput> output);

/// Returns the largest size of a part, mm: the bed less the strip for the priming line, brim and skirt. For
/// grbl it is laser_build_volume.
dvec3 gcode_build_volume(const PrinterProfile& profile, double layer_height);

}  // namespace lamella
