// Writes one section of a part and its supports as SVG, PNG or JSON, in memory.
#pragma once

#include <string>
#include <vector>

#include "engine/contours/contours.h"
#include "engine/field/field.h"
#include "printers/common/profile.h"

namespace lamella {

/// The slices in one plane, and the page to draw.
struct PlaneCut {
    const SliceField& part;
    const SliceField* supports = nullptr;  ///< null for none
    double z = 0;                          ///< mm
    Rect page;                             ///< mm
};

/// Returns an SVG with the part's contours as one filled path and those of supports as another in blue, y up,
/// lengths in mm. Contours lie within `tolerance` mm of the surface.
std::string section_svg(const PlaneCut& cut, double tolerance);

/// Returns {"z", "area_mm2", "contours": [{"hole", "parent", "points": [[x, y], ...]}]}, mm; with supports
/// also "support_area_mm2" and "support_contours".
std::string section_json(const PlaneCut& cut, double tolerance);

/// Returns a PNG of the coverage as grey, at the profile's pixel size and antialiasing, first row at the
/// largest y; supports in their grey. Throws InputError when the page has more than 2^28 pixels.
std::string section_png(const PlaneCut& cut, const PrinterProfile& printer);

}  // namespace lamella
