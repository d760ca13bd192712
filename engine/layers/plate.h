// Plates: arranges several jobs side by side, to be printed as one.
#pragma once

#include <span>
#include <vector>

#include "engine/layers/layer_stream.h"

namespace lamella {

/// A job and its number of copies on the plate.
struct PlateItem {
    Job job;
    int copies = 1;
};

struct PlateOptions : PassControl {
    double gap = 5;           ///< between neighbours, mm
    dvec2 machine{infinity};  ///< size of the machine's plate in x and y, mm; infinite if there is none
    bool turns = false;       ///< whether parts may be turned by right angles
    bool one_by_one = false;  ///< print each part from the bed up before the next: the lowest first
};

/// Returns the jobs of as many plates as it takes, each with its parts side by side, their beds at one
/// height. A single part is returned as it is.
///
/// Where one plate has room for all in rows, they stand in rows along x, from the lower left on; rows are as
/// long as takes up the least share of the plate, or about a square without a machine. Otherwise parts are
/// nested by their outlines, as surveyed (outline_nesting.h), to a thousandth of the plate. Does not check
/// heights: the back-end does. Parts that are printed
/// one by one may have layers of different heights. Throws InputError for a part that is larger than the
/// plate, for layers that differ, and where there are no parts; Interrupted when cancelled.
std::vector<Job> arrange_plates(std::span<const PlateItem> items, const PlateOptions& options);

}  // namespace lamella
