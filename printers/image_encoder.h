// Masks in image formats other than PNG.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "printers/profile.h"

namespace lamella {

/// The file name's ending of a format, with its dot.
const char* extension(ImageFormat format);

/// Encodes an 8-bit grey image, row by row from the top. Throws FaultError when that cannot be done.
std::vector<std::byte> encode_image(ImageFormat format, int width, int height,
                                    const std::vector<std::uint8_t>& pixels);

}  // namespace lamella
