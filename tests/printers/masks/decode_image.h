// Decodes image files with OpenImageIO, the independent reader of these tests.
#pragma once

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace lamella {

struct DecodedImage {
    int width = 0;
    int height = 0;
    std::vector<unsigned char> pixels;
    long pixels_per_metre_x = 0;
    long pixels_per_metre_y = 0;

    int at(int column, int row) const {
        return pixels[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(column)];
    }
    /// Sum of the grey values in units of a full pixel.
    double filled() const {
        double sum = 0;
        for (const unsigned char grey : pixels) sum += grey / 255.0;
        return sum;
    }
};

inline DecodedImage decode_opened(std::unique_ptr<OIIO::ImageInput> input) {
    INFO(OIIO::geterror());
    REQUIRE(input);
    const OIIO::ImageSpec& spec = input->spec();
    REQUIRE(spec.nchannels == 1);
    REQUIRE(spec.format == OIIO::TypeDesc::UINT8);
    DecodedImage image;
    image.width = spec.width;
    image.height = spec.height;
    image.pixels.resize(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height));
    REQUIRE(input->read_image(0, 0, 0, 1, OIIO::TypeDesc::UINT8, image.pixels.data()));
    const std::string unit = spec.get_string_attribute("ResolutionUnit");
    const double per_metre = unit == "m" ? 1 : unit == "cm" ? 100 : 1000 / 25.4;
    image.pixels_per_metre_x = std::lround(spec.get_float_attribute("XResolution") * per_metre);
    image.pixels_per_metre_y = std::lround(spec.get_float_attribute("YResolution") * per_metre);
    return image;
}

inline DecodedImage decode_image(std::span<const std::byte> bytes) {
    OIIO::Filesystem::IOMemReader reader(const_cast<std::byte*>(bytes.data()), bytes.size());
    return decode_opened(OIIO::ImageInput::open("memory.png", nullptr, &reader));
}

inline DecodedImage decode_image(const std::string& path) {
    return decode_opened(OIIO::ImageInput::open(path));
}

}  // namespace lamella
