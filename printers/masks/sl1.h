// Back-end: archives for the resin printers SL1 and SL1S; converters turn them into files for many others.
#pragma once

#include <memory>
#include <string>

#include "engine/layers/backend.h"
#include "printers/common/profile.h"

namespace lamella {

/// Makes a back-end that writes a ZIP archive: NAME00000.png and so on, 8-bit grey masks in the layout of
/// MaskLayout, then config.ini for the machine and prusaslicer.ini for other programs. Layers are appended as
/// they are computed. An interrupted run leaves PATH.partial and can be resumed to the same bytes. The
/// archive contains no time stamp.
std::unique_ptr<Backend> make_sl1(const PrinterProfile& profile, const std::string& path, bool force);

}  // namespace lamella
