// The sheets of a 3MF's image3d as a volume.
#pragma once

#include <optional>
#include <string>

#include "engine/io/opc_package.h"
#include "engine/io/volumetric_3mf.h"
#include "procedural/volume/volume.h"

namespace lamella {

/// A channel, 0 to 3 for red, green, blue and alpha, of all sheets: x along the columns, y against the rows,
/// z along the sheets. Grey images have the same number in red, green and blue; nothing where the images have
/// no alpha, which is 1 then. Sizes are checked before there is room made for them. Throws InputError that
/// begins with `where` for sheets that are missing, damaged, no PNG, or unlike what the stack or the first
/// one says.
std::optional<Volume> read_image_stack(OpcPackage& package, const ImageStack& stack, int channel,
                                       const std::string& where);

}  // namespace lamella
