// CutPlan: the paths to be cut, scored and engraved for one layer.
#pragma once

#include <vector>

#include "engine/base/archive.h"
#include "engine/layers/layer.h"
#include "printers/common/profile.h"
#include "printers/vector/sheet.h"

namespace lamella {

/// The paths of a layer, and peculiarities found while planning them.
struct CutPlan {
    void serialize(Archive& parcel) {
        parcel(paths, extent, area, pieces, closed_holes, merged_pieces, unnumbered);
    }

    std::vector<SheetPath> paths;  ///< in the part's coordinates, mm; in the order of execution
    Rect extent;                   ///< bounding box of all paths, mm; empty for an empty layer
    double area = 0;               ///< of the layer's section, before ties and kerf, mm^2
    int pieces = 0;                ///< number of connected pieces before ties
    int closed_holes = 0;          ///< holes narrower than the kerf, which are not cut
    int merged_pieces = 0;         ///< pieces closer to each other than the kerf, which are not separated
    bool unnumbered = false;       ///< there was no room for the number
};

/// Plans a layer's paths. Cuts follow its contours, to `tolerance` mm, with ties if the layer falls into
/// pieces that are to be joined; all borders are moved out of the material by half the kerf (Clipper, round
/// corners). The number stands where the largest disc of material is clear of borders and scored lines. The
/// next layer's outline is scored where it lies on this layer's material, at least 0.2 mm from its border.
/// Cuts run from the inside out: `inner` are those within another contour, the deepest first. Pure;
/// thread-safe.
CutPlan plan_cuts(const Job& job, const Layer& layer, const CuttingProfile& profile, double tolerance);

/// Returns how far paths may lie outside the bounds of the part, mm.
double cut_allowance(const CuttingProfile& profile);

}  // namespace lamella
