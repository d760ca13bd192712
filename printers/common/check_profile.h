// CheckProfile: limits and severities of the print checks of a machine.
#pragma once

#include <array>

#include "engine/checks/print_limits.h"

namespace lamella {

/// Manufacturing process of a machine, as far as checks depend on it.
enum class Process : unsigned char {
    from_backend,  ///< derived from the profile's back-end, see process_of
    filament,      ///< beads of molten plastic stacked on each other
    resin,         ///< layers cured in a vat, the part hanging from a plate
    powder,        ///< layers of powder that are bound, sintered or melted
    cutting        ///< layers cut out of sheets and stacked
};

/// Severity of a fault: the default of the process (none), or the one given here.
enum class SeverityOverride : unsigned char { none, off, warn, fail };

/// Limits of the checks, lengths in mm. A negative value selects the default of the process (see
/// default_limits).
struct CheckProfile {
    Process process = Process::from_backend;
    double pitch = 0;              ///< distance between sampled rows; 0: chosen from the other limits
    int places = 10;               ///< number of faults of each kind that are listed
    double min_piece = -1;         ///< least volume of a loose piece that matters, mm^3
    double min_island = -1;        ///< least area of an island that matters, mm^2
    double min_thickness = -1;     ///< thickness of walls and struts, within layers
    double min_thickness_up = -1;  ///< thickness along z; 0: layers are checked one by one
    double min_gap = -1;           ///< width of gaps, within layers
    double min_gap_up = -1;        ///< width of gaps along z; 0: layers are checked one by one
    double min_neck = -1;          ///< thickness of necks between large parts
    double large_part = -1;        ///< least volume of a large part, mm^3
    double min_cavity = -1;        ///< least volume of a closed void that matters, mm^3
    double min_cup = -1;           ///< least volume of a suction cup that matters, mm^3
    double max_peel = -1;          ///< greatest area peeled off at once, over a section that carries the pull
    std::array<SeverityOverride, check_count> concerns{};  ///< indexed by Check
};

}  // namespace lamella
