// Pictures of a fault: the section of its layer, with what is wrong in red.
#pragma once

#include <span>
#include <string>

#include "engine/base/picture.h"
#include "engine/checks/print_check.h"
#include "engine/layers/layer.h"

namespace lamella {

/// A part of a layer's plane as a picture, seen from above.
struct SectionPicture {
    Picture picture;
    Rect shown;        ///< mm
    double pixel = 1;  ///< mm

    /// A place of the plane in pixels from the picture's upper left corner.
    dvec2 at(dvec2 p) const { return {(p.x - shown.lo.x) / pixel, (shown.hi.y - p.y) / pixel}; }
};

/// The section of a layer in a rectangle, `width` pixels wide: the part grey, supports blue, the layer below
/// in a light grey, and the runs of a fault, which lie as `band` says, red above all of it.
SectionPicture draw_section(const Job& job, int layer, const Rect& shown, int width,
                            std::span<const PlacedRun> fault, const RowBand& band);

/// What a picture of a fault shows, four wide to three high: the fault in its largest layer with some of what
/// is about it.
Rect about_fault(const Fault& fault, const RowBand& band, const Job& job);

/// What is about a fault, as its layers are printed: cut off at the top of its largest layer and seen from
/// the side, the fault red. As wide as `about_fault` says, and half as deep as that is long.
Picture draw_fault(const Job& job, const Fault& fault, const RowBand& band, int width);

}  // namespace lamella
