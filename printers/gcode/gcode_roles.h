// Properties of a bead that follow from its role: name in comments, speed, acceleration.
#pragma once

#include "printers/common/profile.h"
#include "printers/toolpath/bead.h"

namespace lamella {

/// Returns the name of a bead's role for previewers of the Slic3r family.
const char* role_name(const Bead& bead);
/// Returns the speed of a bead, mm/s.
double role_speed(const PrinterProfile& profile, const Bead& bead, bool first_layer);
/// Returns the acceleration of a bead, mm/s^2.
double role_acceleration(const GcodeProfile& profile, const Bead& bead, bool first_layer);
/// Returns the acceleration of moves without extrusion, mm/s^2.
double travel_acceleration(const GcodeProfile& profile);
/// Returns true if the file sets any acceleration; otherwise the machine keeps its own.
bool sets_acceleration(const GcodeProfile& profile);

}  // namespace lamella
