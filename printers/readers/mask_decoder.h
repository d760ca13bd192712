// Decoders of the layer images of a job.
#pragma once

#include <string>
#include <string_view>

#include "printers/readers/read_job.h"

namespace lamella {

/// How the columns of a mask are stored in its image.
enum class MaskPacking : unsigned char {
    plain,     ///< one column per pixel; of several colours the brightest counts
    in_colors  ///< three columns per pixel, in red, green and blue
};

/// Width and height stated by an image, px. image_size throws InputError with a message that begins with
/// `where`.
struct MaskSize {
    int width = 0;
    int height = 0;
};
MaskSize image_size(const std::string& name, std::string_view bytes, const std::string& where);

/// Decodes an image whose format follows from the extension of `name` (.png, .tif, .bmp, .pgm). Throws
/// InputError with a message that begins with `where` if the image is damaged, larger than max_mask_pixels,
/// or, once unpacked, not of the expected size.
MaskImage decode_mask(const std::string& name, std::string_view bytes, MaskSize expected, MaskPacking packing,
                      const std::string& where);

}  // namespace lamella
