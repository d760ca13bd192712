// Decoding the image files of a job's layers.
#pragma once

#include <string>
#include <string_view>

#include "printers/readers/read_job.h"

namespace lamella {

/// How the columns of a mask stand in its image.
enum class MaskPacking : unsigned char {
    plain,     ///< a pixel each; of colours the brightest counts
    in_colors  ///< red, green and blue of a pixel are three columns side by side
};

/// Width and height that an image states, px. Throws InputError, beginning with `where`.
struct MaskSize {
    int width = 0;
    int height = 0;
};
MaskSize image_size(const std::string& name, std::string_view bytes, const std::string& where);

/// Decodes an image whose format the ending of `name` tells (.png, .tif, .bmp, .pgm). Throws InputError,
/// beginning with `where`, when it is damaged, larger than max_mask_pixels, or, once unpacked, not of the
/// size that is expected.
MaskImage decode_mask(const std::string& name, std::string_view bytes, MaskSize expected, MaskPacking packing,
                      const std::string& where);

}  // namespace lamella
