// Back-end: a folder with one image per layer and a job.json that describes them.
#pragma once

#include <memory>
#include <string>

#include "engine/layers/backend.h"
#include "printers/common/profile.h"

namespace lamella {

/// Makes a back-end that writes PATH/00000.png and so on (or another extension, by the profile's format),
/// 8-bit grey, 255 = solid, numbered by layer index. job.json describes the job, its layers, the size and
/// pixel pitch of the images and their position over the part (see MaskLayout). The folder is renamed when
/// complete (see UnfinishedFolder).
std::unique_ptr<Backend> make_png_stack(const PrinterProfile& profile, const std::string& path, bool force);

}  // namespace lamella
