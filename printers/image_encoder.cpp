// Formats by name, and masks as images.
#include "printers/image_encoder.h"

#include "engine/error.h"
#include "engine/image_file.h"

namespace lamella {

const char* extension(ImageFormat format) {
    switch (format) {
        case ImageFormat::png:
            return ".png";
        case ImageFormat::tiff:
            return ".tif";
        case ImageFormat::bmp:
            return ".bmp";
        case ImageFormat::pgm:
            return ".pgm";
    }
    throw InputError("the image format is neither png, tiff, bmp nor pgm");
}

std::vector<std::byte> encode_image(ImageFormat format, int width, int height,
                                    const std::vector<std::uint8_t>& pixels) {
    const char* compression = format == ImageFormat::tiff ? "packbits" : "rle";
    return encode_image(std::string("mask") + extension(format),
                        {width, height, 1, pixels, 0, 0, false, compression});
}

}  // namespace lamella
