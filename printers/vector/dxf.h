// Back-end: sheets as DXF, for cutters and CAD programs that do not read SVG.
#pragma once

#include <memory>
#include <string>

#include "engine/layers/backend.h"
#include "printers/common/profile.h"

namespace lamella {

/// Makes a back-end that writes ASCII DXF of release 12 (AC1009), the most widely read dialect: closed and
/// open POLYLINEs of straight segments in mm, y upwards, on the layers ENGRAVE, SCORE, CUT_INNER and
/// CUT_OUTER, in the order of execution. $INSUNITS (newer than the release) and $MEASUREMENT declare
/// millimetres to programs that read them; others ignore them. The output is a folder: PATH/00000.dxf and so
/// on, or PATH/sheet_001.dxf with CuttingProfile::sheet.
std::unique_ptr<Backend> make_dxf(const PrinterProfile& profile, const std::string& path, bool force);

}  // namespace lamella
