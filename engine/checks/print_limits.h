// The limits of a process, and the severity of each fault.
#pragma once

#include <array>

#include "engine/base/geometry.h"

namespace lamella {

/// What is looked for. The sizes that faults have are told with each; the worst is the largest.
enum class Check : unsigned char {
    connectivity,  ///< the part is one piece; size: volume of a further piece, mm^3
    sheets,        ///< each layer is one piece (cutters); size: area of all but the largest of a layer, mm^2
    islands,       ///< nothing begins with nothing below it; size: area, mm^2
    overhangs,     ///< nothing stands out too far over what is below; size: area in one layer, mm^2
    bridges,       ///< no stretch between two holds is too long; size: its length, mm
    thickness,     ///< nothing is too thin; size: volume, mm^3
    necks,         ///< nothing that joins large parts is too thin; size: volume of the neck, mm^3
    gaps,          ///< no void is too narrow; size: volume, mm^3
    cavities,      ///< no void is closed off; size: volume, mm^3
    cups,          ///< no void is closed off by the vat's film while it is printed; size: volume, mm^3
    peel,  ///< no section is too small for what is peeled off above; size: area over section, a factor
    build_volume,  ///< all lies within the machine's reach; size: by how much something sticks out, mm
    empty_layers   ///< each layer holds some of the part; size: height of the gap, mm
};
inline constexpr std::size_t check_count = 13;

/// Returns all checks, in their order.
inline std::array<Check, check_count> all_checks() {
    std::array<Check, check_count> checks{};
    for (std::size_t i = 0; i < check_count; ++i) checks[i] = static_cast<Check>(i);
    return checks;
}

/// Whether a fault matters.
enum class Severity : unsigned char { off, warn, fail };

/// What a process can make. Lengths in mm.
struct PrintLimits {
    std::array<Severity, check_count> verdicts{};  ///< by Check, what a fault of it comes to
    double piece = 0;                              ///< volume from which a loose piece matters, mm^3
    double island = 0;                             ///< area from which an island matters, mm^2
    double thickness = 0.4;                        ///< least of walls and struts, within layers
    double thickness_up = 0;                       ///< the same upright; 0: layers are looked at one by one
    double gap = 0.4;                              ///< least width of void, within layers
    double gap_up = 0;                             ///< the same upright; 0: layers are looked at one by one
    double neck = 1;                               ///< least thickness of what joins large parts
    double large_part = 1000;                      ///< volume from which a part is large, mm^3
    double overhang = 0.2;                         ///< by which a layer may stand out over the one below
    bool overhang_grows = false;                   ///< with a layer's height; `overhang` is the least one's
    double free_stretch = 1;                       ///< what hangs and is smaller across needs no hold
    double bridge = 10;                            ///< longest stretch between two holds
    double support_spacing = 3;                    ///< a support holds what lies within this distance
    double support_gap = 0;        ///< height that may lie between a support and what it holds
    double cavity = 1;             ///< volume from which a closed void matters, mm^3
    double cup = 10;               ///< volume from which a suction cup matters, mm^3
    double peel = 60;              ///< area that is peeled off at once, over a section that carries the pull
    dvec3 build_volume{infinity};  ///< width, depth and height that the machine reaches

    Severity verdict(Check check) const { return verdicts[static_cast<std::size_t>(check)]; }
    bool wants(Check check) const { return verdict(check) != Severity::off; }
};

}  // namespace lamella
