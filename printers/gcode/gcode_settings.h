// What a profile's numbers may be for G-code, and all of them as text.
#pragma once

#include <string>

#include "printers/common/profile.h"

namespace lamella {

/// Throws InputError for the first value of a profile that no printer could work with; height is that of a
/// layer, mm.
void check_filament_profile(const PrinterProfile& profile, double height);
/// The same for the speed of printing supports.
void check_support_speed(const SupportProfile& profile);
/// The same for lasers.
void check_laser_profile(const PrinterProfile& profile);

/// All that decides what is written: a file is only continued with the same.
std::string gcode_settings(const PrinterProfile& profile);

}  // namespace lamella
