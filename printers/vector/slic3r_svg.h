// Back-end: a stack of slices in one SVG, as exported by Slic3r for projectors.
#pragma once

#include <memory>
#include <string>

#include "engine/layers/backend.h"
#include "printers/common/profile.h"

namespace lamella {

/// Makes a back-end that writes one group per layer with slic3r:z, the height of its cutting plane above the
/// bed in mm. The group holds polygons, white contours before the black holes in them. The page is the part's
/// bounds; its width and height are mm without a unit, and y points as on the bed: readers of the dialect
/// (Slic3r's own export, Printrun's projector) expect both.
std::unique_ptr<Backend> make_slic3r_svg(const PrinterProfile& profile, const std::string& path, bool force);

}  // namespace lamella
