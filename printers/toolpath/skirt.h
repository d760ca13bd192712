// Loops round the first layer: a brim that holds it to the bed, and a skirt that fills the nozzle.
#pragma once

#include "printers/common/profile.h"
#include "printers/polygons/polygons.h"
#include "printers/toolpath/bead.h"

namespace lamella {

/// From the outside in, for what holds comes last. `standing` is all that the first layer holds; loops run
/// round its outer borders, those near to each other as one.
std::vector<Bead> skirt_beads(const Polygons& standing, const ToolpathProfile& profile,
                              const LineSettings& line);

/// How far they reach beyond what stands on the bed, mm.
double skirt_reach(const ToolpathProfile& profile, const LineSettings& line);

}  // namespace lamella
