// Back-end: a stack of slices in one SVG, as Slic3r exports it for projectors.
#pragma once

#include <memory>
#include <string>

#include "engine/layers/backend.h"
#include "printers/common/profile.h"

namespace lamella {

/// One group a layer with slic3r:z, the height of its cutting plane over the bed in mm, and in it polygons,
/// white contours before the black holes in them. Width and height of the page, the part's bounds, are mm
/// without a unit, and y runs as on the bed: readers of the dialect (Slic3r's own export, Printrun's
/// projector) expect both.
std::unique_ptr<Backend> make_slic3r_svg(const PrinterProfile& profile, const std::string& path, bool force);

}  // namespace lamella
