// Back-end: archives for the resin printer Autodesk Ember.
#pragma once

#include <memory>
#include <string>

#include "engine/layers/backend.h"
#include "printers/common/profile.h"

namespace lamella {

/// Writes a tar.gz: printsettings (thickness and exposures), layersettings.csv where exposures fade, then
/// slice_1.png, slice_2.png and so on, each compressed by itself, as they are computed. Nothing is put in
/// later, so a pipe takes it as well as a file. A stopped run leaves PATH.partial, and a later one goes on
/// from there to the same bytes. Nothing in it tells the time.
std::unique_ptr<Backend> make_ember(const PrinterProfile& profile, const std::string& path, bool force);

}  // namespace lamella
