// What is to be cut, scored and engraved of one layer.
#pragma once

#include <vector>

#include "engine/base/archive.h"
#include "engine/layers/layer.h"
#include "printers/common/profile.h"
#include "printers/vector/sheet.h"

namespace lamella {

/// The paths of a layer and what became of it on the way.
struct CutPlan {
    void serialize(Archive& parcel) {
        parcel(paths, extent, area, pieces, closed_holes, merged_pieces, unnumbered);
    }

    std::vector<SheetPath> paths;  ///< in the part's coordinates, mm; ordered as they are to be done
    Rect extent;                   ///< of all paths, mm; empty for an empty layer
    double area = 0;               ///< of the layer's section, untouched by ties and kerf, mm^2
    int pieces = 0;                ///< into which the section falls before it is tied
    int closed_holes = 0;          ///< narrower than the kerf: not cut
    int merged_pieces = 0;         ///< nearer to each other than the kerf: not cut apart
    bool unnumbered = false;       ///< no room for the number
};

/// Plans a layer's cuts: its contours, to `tolerance` mm; ties, if it falls into pieces and they are to be
/// joined; all borders moved out of the material by half the kerf (Clipper, round corners); numbers where the
/// largest disc of material is clear of borders and scored lines; and where the next layer's outline lies on
/// this layer's material, at least 0.2 mm from its border. Cuts run from the inside out: `inner` are those
/// within another contour, the deepest first. Pure; thread-safe.
CutPlan plan_cuts(const Job& job, const Layer& layer, const CuttingProfile& profile, double tolerance);

/// By how much paths may lie outside the bounds of the part, mm.
double cut_allowance(const CuttingProfile& profile);

}  // namespace lamella
