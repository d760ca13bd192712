// The parts of a layer that hang in the air, and whether beads laid straight can bridge them.
#pragma once

#include <optional>

#include "engine/checks/fault_list.h"

namespace lamella {

/// For each component of a layer whether the diagonal of its bounds is as long as `least`, mm.
std::vector<std::uint8_t> reaching(const LabelledLayer& labelled, double least, const CheckGrid& grid);

/// A connected region of a layer that nothing below holds.
struct HangingRegion {
    std::vector<PlacedRun> runs;   ///< by row
    std::optional<double> bridge;  ///< longest way from hold to hold, laid in the direction where that is
                                   ///< least, mm; empty: in no direction every way ends in holds
};

/// The regions of `hanging`, rows of a layer whose other parts, `held`, something below holds; those whose
/// diagonal is shorter than `least`, mm, are left out. Directions are sixteen of the half circle and each
/// region's own two axes; ways are known to a pitch or two.
std::vector<HangingRegion> find_hanging_regions(const RunRows& hanging, const RunRows& held, double least,
                                                int layer, const CheckGrid& grid);

}  // namespace lamella
