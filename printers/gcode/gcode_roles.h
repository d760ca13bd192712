// What G-code makes of a bead's role: its name in comments, its speed, its acceleration.
#pragma once

#include "printers/common/profile.h"
#include "printers/toolpath/bead.h"

namespace lamella {

/// The name by which previewers of the Slic3r family know what a bead is for.
const char* role_name(const Bead& bead);
/// Speed of a bead, mm/s.
double role_speed(const PrinterProfile& profile, const Bead& bead, bool first_layer);
/// Acceleration of a bead, mm/s^2.
double role_acceleration(const GcodeProfile& profile, const Bead& bead, bool first_layer);
/// Acceleration of moves without extrusion, mm/s^2.
double travel_acceleration(const GcodeProfile& profile);
/// Whether any acceleration is set in the file; otherwise the machine keeps its own.
bool sets_acceleration(const GcodeProfile& profile);

}  // namespace lamella
