// Brim and skirt: loops around the first layer that hold it to the bed and prime the nozzle.
#pragma once

#include "printers/common/profile.h"
#include "printers/polygons/polygons.h"
#include "printers/toolpath/bead.h"

namespace lamella {

/// Returns the loops from the outside in, so that the brim is printed last. `standing` is the whole section
/// of the first layer. Loops follow its outer borders; adjacent borders share loops.
std::vector<Bead> skirt_beads(const Polygons& standing, const ToolpathProfile& profile,
                              const LineSettings& line);

/// Returns the reach of the loops beyond the first layer, mm.
double skirt_reach(const ToolpathProfile& profile, const LineSettings& line);

}  // namespace lamella
