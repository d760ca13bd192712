// Back-end: contours as SVG, one file with a group per layer or a folder with a file per layer.
#pragma once

#include <memory>
#include <string>

#include "engine/layers/backend.h"
#include "printers/common/profile.h"

namespace lamella {

/// Makes a back-end that writes true millimetres: width and height carry the unit and the viewBox has the
/// same numbers. The page is the part's bounds with a margin around them, equal for all layers; y is flipped
/// in the coordinates. A layer is one path of straight segments, inner contours before the outer ones that
/// enclose them; no transforms, no text.
///
/// One file (PATH): filled layers as Inkscape layers, each with slic3r:z, the height of its top, mm. For
/// viewers, editors and projectors. A folder (PATH/00000.svg and job.json): outlines as red hairlines, which
/// laser cutters take for cuts.
std::unique_ptr<Backend> make_svg(const PrinterProfile& profile, const std::string& path, bool force);

}  // namespace lamella
