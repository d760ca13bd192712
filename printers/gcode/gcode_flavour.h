// What differs between the dialects of G-code: words for the fan, progress and acceleration, and default
// scripts.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "printers/common/gcode_profile.h"

namespace lamella {

/// Bytes of the longest line that the firmware takes: Marlin's MAX_CMD_SIZE of 96 with its end, GRBL's
/// LINE_BUFFER_SIZE of 80.
std::size_t longest_line(Flavour flavour);

/// Scripts that hold where a profile has none; see gcode_script.h for their variables.
std::string_view default_start_script(Flavour flavour);
std::string_view default_layer_script(Flavour flavour);
std::string_view default_end_script(Flavour flavour);

/// The fan at a share of its full speed, 0 to 1.
std::string fan_line(Flavour flavour, double share);

/// How far a print is: before the first of `layers` layers, before layer `layer` (from 0), and at the end.
/// Of the time that is left nothing is said: while layers are made one by one it is not known.
std::string start_progress(Flavour flavour, int layers);
std::string layer_progress(Flavour flavour, int layer, int layers);
std::string end_progress(Flavour flavour, int layers);

/// Whether accelerations of extruding and other moves are set apart (M204 P T) or are one (M204 S).
bool has_travel_acceleration(Flavour flavour);
/// Sets the acceleration of extruding moves, mm/s^2; of all where they are one.
std::string acceleration_line(Flavour flavour, double acceleration);
/// Sets that of other moves, where they are set apart.
std::string travel_acceleration_line(double acceleration);

/// The laser at a share of its full power, moving (GRBL 1.1: M3 constant, M4 following the speed).
std::string laser_on_line(const LaserProfile& laser);

}  // namespace lamella
