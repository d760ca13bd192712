// Scripts: the user's own lines at the start, at layers and at the end of a G-code file.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "printers/common/gcode_profile.h"

namespace lamella {

/// Values of the variables in a script. A variable has the name of its member. Doubled braces stand for
/// braces.
struct ScriptValues {
    int layer = 0;                                       ///< the next layer, from 1; at the end the last one
    int layers = 0;                                      ///< number of layers of the print
    double z = 0;                                        ///< height of the layer's top, mm
    double height = 0;                                   ///< height of a layer, mm
    double nozzle_temperature = 0, bed_temperature = 0;  ///< for that layer, degrees Celsius
    double nozzle = 0;                                   ///< diameter, mm
    double bed_x = 0, bed_y = 0, bed_z = 0;              ///< mm
    double filament_used = 0;                            ///< filament used so far, mm
    int tool = 0, previous_tool = 0;  ///< the tool in use, or to change to, and the last one
};

/// Returns the first mistake in a script, such as "line 3: there is no variable {laier}; ...", or nothing.
/// The length of lines is checked with the longest values that variables can have.
std::optional<std::string> script_mistake(std::string_view script, Flavour flavour);

/// Returns the script's lines, each with a line feed, with variables replaced. The script must be free of
/// mistakes.
std::string expand_script(std::string_view script, const ScriptValues& values);

/// Throws InputError for the first mistake in the scripts of a profile.
void check_scripts(const GcodeProfile& profile);

/// The scripts in effect: those of the profile, or the defaults of its flavour.
std::string start_script(const GcodeProfile& profile);
std::string layer_script(const GcodeProfile& profile);
std::string end_script(const GcodeProfile& profile);
std::string tool_script(const GcodeProfile& profile);

}  // namespace lamella
