// Dialects of G-code: commands for fan, progress and acceleration, and default scripts.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "printers/common/gcode_profile.h"

namespace lamella {

/// Returns the longest line that the firmware accepts, bytes: Marlin's MAX_CMD_SIZE of 96 includes the line
/// end, GRBL's LINE_BUFFER_SIZE is 80.
std::size_t longest_line(Flavour flavour);

/// Default scripts, used if a profile has none; see gcode_script.h for their variables.
std::string_view default_start_script(Flavour flavour);
std::string_view default_layer_script(Flavour flavour);
std::string_view default_end_script(Flavour flavour);
inline constexpr std::string_view default_tool_script = "T{tool}\nM109 S{nozzle_temperature}";

/// Returns the line that lets a tool cool down, or heats it, without waiting, degrees Celsius.
std::string heat_line(Flavour flavour, int tool, double temperature);

/// Returns the line that sets the fan to a share of its full speed, 0 to 1.
std::string fan_line(Flavour flavour, double share);

/// Progress reports: before the first of `layers` layers, before layer `layer` (from 0), and at the end. They
/// do not state the remaining time, which is unknown while layers are produced one by one.
std::string start_progress(Flavour flavour, int layers);
std::string layer_progress(Flavour flavour, int layer, int layers);
std::string end_progress(Flavour flavour, int layers);

/// Returns true if extruding moves and other moves have separate accelerations (M204 P T), false if they
/// share one (M204 S).
bool has_travel_acceleration(Flavour flavour);
/// Sets the acceleration of extruding moves, mm/s^2; that of all moves if they share one.
std::string acceleration_line(Flavour flavour, double acceleration);
/// Sets the acceleration of other moves, mm/s^2, if it is separate.
std::string travel_acceleration_line(double acceleration);

/// Switches the laser on for moves at a share of its full power (GRBL 1.1: M3 constant, M4 following the
/// speed).
std::string laser_on_line(const LaserProfile& laser);

}  // namespace lamella
