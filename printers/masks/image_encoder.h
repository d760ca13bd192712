// Encoders of masks in image formats other than PNG.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "printers/common/profile.h"

namespace lamella {

/// Returns the file name extension of a format, with its dot.
const char* extension(ImageFormat format);

/// Encodes an 8-bit grey image, row by row from the top. Throws FaultError if that fails.
std::vector<std::byte> encode_image(ImageFormat format, int width, int height,
                                    const std::vector<std::uint8_t>& pixels);

/// Writes the pixel size (mm) into a BMP file: machines derive the image's size from it.
void set_bmp_pixel_size(std::vector<std::byte>& file, double pixel_x, double pixel_y);

}  // namespace lamella
