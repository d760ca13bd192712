// Scripts: a user's own lines at the start, at layers and at the end of a G-code file.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "printers/common/gcode_profile.h"

namespace lamella {

/// What stands for variables: their names are those of the members. Doubled braces stand for braces.
struct ScriptValues {
    int layer = 0;      ///< from 1: the one that follows; at the end the last one
    int layers = 0;     ///< of the whole print
    double z = 0;       ///< of the layer's top, mm
    double height = 0;  ///< of a layer, mm
    double nozzle_temperature = 0, bed_temperature = 0;  ///< for that layer, degrees Celsius
    double nozzle = 0;                                   ///< diameter, mm
    double bed_x = 0, bed_y = 0, bed_z = 0;              ///< mm
    double filament_used = 0;                            ///< so far, mm
};

/// What is wrong with a script, and where: "line 3: there is no variable {laier}; ...". Lines are measured
/// with the longest values that variables can have.
std::optional<std::string> script_mistake(std::string_view script, Flavour flavour);

/// The script's lines, each with a line feed, with values for variables. The script is free of mistakes.
std::string expand_script(std::string_view script, const ScriptValues& values);

/// Throws InputError for the first mistake in the scripts of a profile.
void check_scripts(const GcodeProfile& profile);

/// The scripts that hold: the profile's, or where it has none the flavour's usual ones.
std::string start_script(const GcodeProfile& profile);
std::string layer_script(const GcodeProfile& profile);
std::string end_script(const GcodeProfile& profile);

}  // namespace lamella
