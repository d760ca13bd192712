// ToolProfile: one of several tools (extruders) of a machine, and how the nozzle is purged between them.
#pragma once

#include <string>

namespace lamella {

/// Temperatures in degrees Celsius.
struct ToolProfile {
    std::string name;
    double nozzle_temperature = 0;              ///< 0: that of the machine
    double first_layer_nozzle_temperature = 0;  ///< 0: as for the other layers
    double standby_temperature = 0;             ///< while another tool prints; 0: it stays hot
    double density = 0;                         ///< of its filament, g/cm3; 0: that of the machine
};

/// The tower in which the nozzle is purged after a change of tools. Lengths in mm.
struct PurgeProfile {
    double volume = 45;     ///< extruded after each change, mm^3; 0: no tower
    double width = 30;      ///< of the tower along x
    double gap = 5;         ///< between part and tower
    double density = 0.25;  ///< share of the tower that is filled where nothing is purged, 0.05 to 1
};

}  // namespace lamella
