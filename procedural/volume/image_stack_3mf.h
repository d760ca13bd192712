// Reads the sheets of a 3MF's image3d as a volume.
#pragma once

#include <optional>
#include <string>

#include "engine/io/opc_package.h"
#include "engine/io/volumetric_3mf.h"
#include "procedural/volume/volume.h"

namespace lamella {

/// Reads one channel (0 to 3 for red, green, blue and alpha) of all sheets: x along columns, y against rows,
/// z along sheets. Grey images have equal red, green and blue. Returns none if alpha is requested and the
/// images have none; the caller then takes 1. Sizes are checked before memory is allocated. Throws
/// InputError, with `where` in front, for sheets that are missing, damaged, not PNG, or different from the
/// stack's description or the first sheet.
std::optional<Volume> read_image_stack(OpcPackage& package, const ImageStack& stack, int channel,
                                       const std::string& where);

}  // namespace lamella
