// Back-end: sheets as DXF, for cutters and CAD programs that take no SVG.
#pragma once

#include <memory>
#include <string>

#include "engine/layers/backend.h"
#include "printers/common/profile.h"

namespace lamella {

/// ASCII DXF of release 12 (AC1009), the dialect that everything reads: closed and open POLYLINEs of straight
/// segments in mm, y upwards, on the layers ENGRAVE, SCORE, CUT_INNER and CUT_OUTER, in the order in which
/// they are to be done. $INSUNITS, which is younger than the release, and $MEASUREMENT say millimetres to the
/// programs that look for them; the others ignore them. A folder: PATH/00000.dxf and so on, or
/// PATH/sheet_001.dxf with CuttingProfile::sheet.
std::unique_ptr<Backend> make_dxf(const PrinterProfile& profile, const std::string& path, bool force);

}  // namespace lamella
