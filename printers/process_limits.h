// What is known of the processes that machines work by: which faults matter to them, and how small they make.
#pragma once

#include "printers/common/profile.h"

namespace lamella {

/// Least sizes and verdicts of a process where nothing else is known, after the table of manufacturing
/// constraints by process in J. Dumas, "Controllable Shape Synthesis for Digital Fabrication", 2017 (table
/// 2.1). Sizes that depend on the machine (lines, pixels, kerf) are the profile's.
PrintLimits default_limits(Process process, const PrinterProfile& profile);

/// The usual limits of the profile's process with what its CheckProfile says over them, and its supports'
/// free_stretch, own_bridge, spacing and gap. The overhang and the build volume depend on the job and are
/// left as they are.
PrintLimits process_limits(const PrinterProfile& profile);

}  // namespace lamella
