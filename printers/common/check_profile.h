// What a profile says of print checks: what its machine can make, and which faults matter.
#pragma once

#include <array>

#include "engine/checks/print_limits.h"

namespace lamella {

/// How a machine makes parts, as far as checks go.
enum class Process : unsigned char {
    from_backend,  ///< as the profile's back-end does, see process_of
    filament,      ///< beads of molten plastic on each other
    resin,         ///< layers cured in a vat, the part hanging from a plate
    powder,        ///< layers of powder bound, sintered or melted
    cutting        ///< layers cut out of sheets, and stacked
};

/// What a fault comes to: as usual for the process, or as the profile says.
enum class SeverityOverride : unsigned char { none, off, warn, fail };

/// Sizes in mm; a negative one is the usual one of the process (see default_limits).
struct CheckProfile {
    Process process = Process::from_backend;
    double pitch = 0;              ///< from row to row of the check; 0: what suits the other sizes
    int places = 10;               ///< faults of each kind that are told of
    double min_thickness = -1;     ///< of walls and struts, within layers
    double min_thickness_up = -1;  ///< the same upright; 0: layers are looked at one by one
    double min_gap = -1;           ///< width of void, within layers
    double min_gap_up = -1;        ///< the same upright; 0: layers are looked at one by one
    double min_neck = -1;          ///< thickness of what joins large parts
    double large_part = -1;        ///< volume from which a part is large, mm^3
    double min_cavity = -1;        ///< volume from which a closed void matters, mm^3
    double min_cup = -1;           ///< volume from which a suction cup matters, mm^3
    std::array<SeverityOverride, check_count> concerns{};  ///< by Check
};

}  // namespace lamella
