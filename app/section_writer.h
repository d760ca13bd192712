// One section of a part as SVG, PNG or JSON, in memory.
#pragma once

#include <string>
#include <vector>

#include "engine/contours.h"
#include "engine/field.h"
#include "printers/profile.h"

namespace lamella {

/// The contours as one filled path, y up, lengths in mm; the page is `page`.
std::string section_svg(const std::vector<Contour>& contours, const Rect& page);

/// {"z", "area_mm2", "contours": [{"hole", "parent", "points": [[x, y], ...]}]}, mm.
std::string section_json(const std::vector<Contour>& contours, double z);

/// Grey coverage at the profile's pixel size and antialiasing, first row at the largest y. Throws InputError
/// when the page has more than 2^28 pixels.
std::string section_png(const SliceField& slice, const Rect& page, const ImageProfile& image);

}  // namespace lamella
