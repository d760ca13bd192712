// Pictures of a fault: the section of its layer with the fault in red.
#pragma once

#include <span>
#include <string>

#include "engine/base/picture.h"
#include "engine/checks/print_check.h"
#include "engine/layers/layer.h"

namespace lamella {

/// A picture of a rectangle of a layer's plane, seen from above.
struct SectionPicture {
    Picture picture;
    Rect shown;        ///< mm
    double pixel = 1;  ///< mm

    /// Converts a point of the plane to pixels from the picture's upper left corner.
    dvec2 at(dvec2 p) const { return {(p.x - shown.lo.x) / pixel, (shown.hi.y - p.y) / pixel}; }
};

/// Draws the section of a layer in a rectangle, `width` pixels wide: the part grey, supports blue, the layer
/// below light grey, and on top in red the runs of a fault, whose lines are those of `band`.
SectionPicture draw_section(const Job& job, int layer, const Rect& shown, int width,
                            std::span<const PlacedRun> fault, const RowBand& band);

/// Returns the rectangle for a picture of a fault (aspect ratio 4:3): the fault in its largest layer with
/// some surroundings.
Rect about_fault(const Fault& fault, const RowBand& band, const Job& job);

/// Draws the surroundings of a fault as printed: cut off at the top of the fault's largest layer and seen
/// from the side, the fault red. The width is that of about_fault's rectangle; layers are shown down to half
/// its extent in y below the cut.
Picture draw_fault(const Job& job, const Fault& fault, const RowBand& band, int width);

}  // namespace lamella
