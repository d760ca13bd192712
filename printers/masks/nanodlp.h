// Back-end: ZIP archives for NanoDLP, the host of many resin printers with projectors and displays.
#pragma once

#include <memory>
#include <string>

#include "engine/layers/backend.h"
#include "printers/common/profile.h"

namespace lamella {

/// Makes a back-end that writes a ZIP archive: 1.png, 2.png and so on as they are computed, then descriptions
/// of the layers (info.json: areas in mm^2, islands and extents of each mask), the plate, the exposures and
/// the display. An interrupted run leaves PATH.partial and can be resumed to the same bytes. The archive
/// contains no time stamp.
std::unique_ptr<Backend> make_nanodlp(const PrinterProfile& profile, const std::string& path, bool force);

}  // namespace lamella
