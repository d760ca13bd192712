// Image formats by name, and their encoders.
#include "printers/masks/image_encoder.h"

#include <cmath>

#include "engine/base/error.h"
#include "engine/io/image_file.h"

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

void set_bmp_pixel_size(std::vector<std::byte>& file, double pixel_x, double pixel_y) {
    // biXPelsPerMeter and biYPelsPerMeter: pixels per metre, four bytes each, the lowest first.
    constexpr std::size_t place = 38;
    if (file.size() < place + 8) throw FaultError("a BMP is shorter than its header");
    std::size_t at = place;
    for (const double pixel : {pixel_x, pixel_y}) {
        const auto per_metre = static_cast<std::uint32_t>(std::lround(1000 / pixel));
        for (unsigned shift = 0; shift < 32; shift += 8) file[at++] = std::byte(per_metre >> shift & 0xffU);
    }
}

}  // namespace lamella
