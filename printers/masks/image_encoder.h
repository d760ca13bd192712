// Masks in image formats other than PNG.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "printers/common/profile.h"

namespace lamella {

/// The file name's ending of a format, with its dot.
const char* extension(ImageFormat format);

/// Encodes an 8-bit grey image, row by row from the top. Throws FaultError when that cannot be done.
std::vector<std::byte> encode_image(ImageFormat format, int width, int height,
                                    const std::vector<std::uint8_t>& pixels);

/// Writes the size of a pixel, mm, into a BMP: machines take an image's size from it.
void set_bmp_pixel_size(std::vector<std::byte>& file, double pixel_x, double pixel_y);

}  // namespace lamella
