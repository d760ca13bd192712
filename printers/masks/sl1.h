// Back-end: archives for the resin printers SL1 and SL1S, which converters take for many others.
#pragma once

#include <memory>
#include <string>

#include "engine/layers/backend.h"
#include "printers/common/profile.h"

namespace lamella {

/// Writes a ZIP archive: NAME00000.png and so on, 8-bit grey masks as MaskLayout lays them, then config.ini
/// for the machine and prusaslicer.ini for programs. Layers are appended as they are computed; a stopped run
/// leaves PATH.partial, and a later one goes on from there to the same bytes. Nothing in it tells the time.
std::unique_ptr<Backend> make_sl1(const PrinterProfile& profile, const std::string& path, bool force);

}  // namespace lamella
