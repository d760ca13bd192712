// Commands by dialect: Marlin 2, Klipper, RepRapFirmware 3, GRBL 1.1.
#include "printers/gcode/gcode_flavour.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/number_format.h"

namespace lamella {

std::size_t longest_line(Flavour flavour) { return flavour == Flavour::grbl ? 79 : 95; }

std::string_view default_start_script(Flavour flavour) {
    // The user decides the homed position of a laser.
    if (flavour == Flavour::grbl) return "";
    return "M140 S{bed_temperature}\nM104 S{nozzle_temperature}\nG28\nM190 S{bed_temperature}\n"
           "M109 S{nozzle_temperature}";
}

std::string_view default_layer_script(Flavour flavour) { return flavour == Flavour::grbl ? "M0" : ""; }

std::string_view default_end_script(Flavour flavour) {
    return flavour == Flavour::grbl ? "M2" : "M104 S0\nM140 S0\nM107\nM84";
}

std::string heat_line(Flavour flavour, int tool, double temperature) {
    const std::string degrees = format_number(temperature, 0);
    // M104 would make another tool's temperature the active one for good.
    if (flavour == Flavour::reprapfirmware && temperature > 0)
        return fmt::format("G10 P{} R{}", tool, degrees);
    return fmt::format("M104 T{} S{}", tool, degrees);
}

std::string fan_line(Flavour flavour, double share) {
    if (!(share > 0)) return "M107";
    // RepRapFirmware interprets numbers up to 1 as shares.
    if (flavour == Flavour::reprapfirmware) return "M106 P0 S" + format_number(share, 3);
    return "M106 S" + format_number(std::max(1.0, share * 255), 0);
}

std::string start_progress(Flavour flavour, int layers) {
    if (flavour == Flavour::klipper) return fmt::format("SET_PRINT_STATS_INFO TOTAL_LAYER={}", layers);
    return "M73 P0";
}

std::string layer_progress(Flavour flavour, int layer, int layers) {
    if (flavour == Flavour::klipper) return fmt::format("SET_PRINT_STATS_INFO CURRENT_LAYER={}", layer + 1);
    return fmt::format("M73 P{}", 100LL * layer / layers);
}

std::string end_progress(Flavour flavour, int layers) {
    if (flavour == Flavour::klipper) return fmt::format("SET_PRINT_STATS_INFO CURRENT_LAYER={}", layers);
    return "M73 P100 R0";
}

bool has_travel_acceleration(Flavour flavour) { return flavour != Flavour::klipper; }

std::string acceleration_line(Flavour flavour, double acceleration) {
    return (has_travel_acceleration(flavour) ? "M204 P" : "M204 S") + format_number(acceleration, 0);
}

std::string travel_acceleration_line(double acceleration) {
    return "M204 T" + format_number(acceleration, 0);
}

std::string laser_on_line(const LaserProfile& laser) { return laser.dynamic_power ? "M4 S0" : "M3 S0"; }

}  // namespace lamella
