// Validation of a profile's settings for G-code, and their description as text.
#pragma once

#include <string>

#include "printers/common/profile.h"

namespace lamella {

/// Throws InputError for the first value of a profile that no printer can work with. `height` is the layer
/// height, mm.
void check_filament_profile(const PrinterProfile& profile, double height);
/// Throws InputError for an invalid speed of supports.
void check_support_speed(const SupportProfile& profile);
/// Throws InputError for the first value of a profile that no laser can work with.
void check_laser_profile(const PrinterProfile& profile);

/// Returns all settings that affect the output as text; a file is only resumed with equal settings.
std::string gcode_settings(const PrinterProfile& profile);

}  // namespace lamella
