// Back-end: tar.gz archives for the resin printer Autodesk Ember.
#pragma once

#include <memory>
#include <string>

#include "engine/layers/backend.h"
#include "printers/common/profile.h"

namespace lamella {

/// Makes a back-end that writes a tar.gz: printsettings (thickness and exposures), layersettings.csv if
/// exposures fade, then slice_1.png, slice_2.png and so on as they are computed, each compressed by itself.
/// Nothing is rewritten afterwards, so the output may be a pipe. An interrupted run leaves PATH.partial and
/// can be resumed to the same bytes. The archive contains no time stamp.
std::unique_ptr<Backend> make_ember(const PrinterProfile& profile, const std::string& path, bool force);

}  // namespace lamella
