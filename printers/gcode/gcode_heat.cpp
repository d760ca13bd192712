// The tool's numbers before those of the machine.
#include "printers/gcode/gcode_heat.h"

namespace lamella {

ToolProfile tool_profile(const PrinterProfile& profile, int tool) {
    const auto number = static_cast<std::size_t>(tool);
    return number < profile.tools.size() ? profile.tools[number] : ToolProfile{};
}

double nozzle_temperature(const PrinterProfile& profile, int tool, bool first_layer) {
    const ToolProfile own = tool_profile(profile, tool);
    const double other =
        own.nozzle_temperature > 0 ? own.nozzle_temperature : profile.filament.nozzle_temperature;
    if (!first_layer) return other;
    if (own.first_layer_nozzle_temperature > 0) return own.first_layer_nozzle_temperature;
    if (own.nozzle_temperature > 0) return own.nozzle_temperature;
    const double first = profile.gcode.first_layer_nozzle_temperature;
    return first > 0 ? first : other;
}

double bed_temperature(const PrinterProfile& profile, bool first_layer) {
    const double first = profile.gcode.first_layer_bed_temperature;
    return first_layer && first > 0 ? first : profile.filament.bed_temperature;
}

}  // namespace lamella
