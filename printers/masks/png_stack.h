// Back-end: a folder of PNG masks, one a layer, with a job.json that describes them.
#pragma once

#include <memory>
#include <string>

#include "engine/layers/backend.h"
#include "printers/common/profile.h"

namespace lamella {

/// Writes PATH/00000.png (or another ending, by the profile's format) and so on, 8-bit grey, 255 = solid,
/// numbered by the layer's index, and job.json: the job, its layers, the size and pitch of the images and
/// where they lie over the part (see MaskLayout). The folder gets its name when complete (see
/// UnfinishedFolder).
std::unique_ptr<Backend> make_png_stack(const PrinterProfile& profile, const std::string& path, bool force);

}  // namespace lamella
