// Back-end: archives for NanoDLP, the host of many resin printers with projectors and displays.
#pragma once

#include <memory>
#include <string>

#include "engine/layers/backend.h"
#include "printers/common/profile.h"

namespace lamella {

/// Writes a ZIP archive: 1.png, 2.png and so on as they are computed, then what is known of layers
/// (info.json: areas in mm^2, islands and extents of each mask), plate, exposures and display. A stopped run
/// leaves PATH.partial, and a later one goes on from there to the same bytes. Nothing in it tells the time.
std::unique_ptr<Backend> make_nanodlp(const PrinterProfile& profile, const std::string& path, bool force);

}  // namespace lamella
