// Temperatures of a job's tools and bed by layer, degrees Celsius.
#pragma once

#include "printers/common/profile.h"

namespace lamella {

/// Returns a tool's own settings; the default ones where the machine has a single tool.
ToolProfile tool_profile(const PrinterProfile& profile, int tool);

/// Returns the temperature of a tool's nozzle in a first layer or another: the tool's own, or the machine's.
double nozzle_temperature(const PrinterProfile& profile, int tool, bool first_layer);
double bed_temperature(const PrinterProfile& profile, bool first_layer);

}  // namespace lamella
