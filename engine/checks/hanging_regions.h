// Hanging regions: the parts of a layer without support, and whether straight beads can bridge them.
#pragma once

#include <optional>

#include "engine/checks/fault_list.h"

namespace lamella {

/// Returns a flag for each component of a layer: 1 if the diagonal of its bounds is at least `least` mm long.
std::vector<std::uint8_t> reaching(const LabelledLayer& labelled, double least, const CheckGrid& grid);

/// A connected region of a layer that nothing below supports.
struct HangingRegion {
    std::vector<PlacedRun> runs;  ///< by row
    std::optional<double>
        bridge;  ///< length of the longest bridge, in the direction in which that is shortest,
                 ///< mm; empty if in every direction some bridge lacks support at an end
};

/// Finds the regions of `hanging`, the unsupported rows of a layer; `held` are the layer's supported rows.
/// Leaves out regions whose diagonal is shorter than `least` mm. Tries sixteen directions of the half circle
/// and each region's two principal axes. Bridge lengths are exact to a pitch or two.
std::vector<HangingRegion> find_hanging_regions(const RunRows& hanging, const RunRows& held, double least,
                                                int layer, const CheckGrid& grid);

}  // namespace lamella
