// Masks of other programs: colours, alpha, other depths.
#include "printers/readers/mask_decoder.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <catch2/catch.hpp>

#include "engine/base/error.h"

namespace mask_decoder_test {

using namespace lamella;

namespace {

/// An image file that OpenImageIO makes of these samples.
template <typename Sample>
std::string image(const std::string& format, int width, int height, int channels, OIIO::TypeDesc type,
                  const std::vector<Sample>& samples) {
    std::vector<unsigned char> file;
    OIIO::Filesystem::IOVecOutput memory(file);
    const auto output = OIIO::ImageOutput::create("image" + format, &memory);
    REQUIRE(output);
    OIIO::ImageSpec spec(width, height, channels, type);
    spec.attribute("oiio:UnassociatedAlpha", 1);
    REQUIRE(output->open("image" + format, spec));
    REQUIRE(output->write_image(type, samples.data()));
    REQUIRE(output->close());
    return {file.begin(), file.end()};
}

using Bytes = std::vector<std::uint8_t>;

Bytes decoded(const std::string& format, const std::string& file, MaskSize size,
              MaskPacking packing = MaskPacking::plain) {
    return decode_mask("layer" + format, file, size, packing, "here").pixels;
}

}  // namespace

TEST_CASE("grey masks come back from every format", "[mask-decoder]") {
    const Bytes greys{0, 1, 2, 100, 254, 255};
    for (const std::string format : {".png", ".tif", ".bmp", ".pgm"}) {
        INFO(format);
        const std::string file = image(format, 3, 2, 1, OIIO::TypeDesc::UINT8, greys);
        CHECK(decoded(format, file, {3, 2}) == greys);
        CHECK(image_size("layer" + format, file, "here").width == 3);
    }
}

TEST_CASE("the brightest colour counts, alpha does not", "[mask-decoder]") {
    CHECK(decoded(".png", image<std::uint8_t>(".png", 2, 1, 3, OIIO::TypeDesc::UINT8, {1, 2, 3, 30, 20, 10}),
                  {2, 1}) == Bytes{3, 30});
    CHECK(decoded(
              ".png",
              image<std::uint8_t>(".png", 2, 1, 4, OIIO::TypeDesc::UINT8, {9, 9, 9, 255, 200, 200, 200, 20}),
              {2, 1}) == Bytes{9, 200});
    CHECK(decoded(".png", image<std::uint16_t>(".png", 3, 1, 1, OIIO::TypeDesc::UINT16, {0, 0x8080, 0xffff}),
                  {3, 1}) == Bytes{0, 128, 255});
}

TEST_CASE("three columns to a pixel are taken apart", "[mask-decoder]") {
    const std::string file =
        image<std::uint8_t>(".png", 2, 1, 3, OIIO::TypeDesc::UINT8, {1, 2, 3, 30, 20, 10});
    CHECK(decoded(".png", file, {6, 1}, MaskPacking::in_colors) == Bytes{1, 2, 3, 30, 20, 10});
    const std::string grey = image<std::uint8_t>(".png", 2, 1, 1, OIIO::TypeDesc::UINT8, {1, 2});
    CHECK_THROWS_WITH(decoded(".png", grey, {6, 1}, MaskPacking::in_colors),
                      Catch::Contains("no three colours"));
}

TEST_CASE("images of another size or kind are refused with their place", "[mask-decoder]") {
    const std::string file = image<std::uint8_t>(".png", 2, 2, 1, OIIO::TypeDesc::UINT8, {1, 2, 3, 4});
    CHECK_THROWS_WITH(decoded(".png", file, {3, 2}),
                      "here: the image is of 2 x 2 px where 3 x 2 px are expected");
    CHECK_THROWS_AS(decoded(".png", "", {2, 2}), InputError);
    CHECK_THROWS_AS(decoded(".tif", file, {2, 2}), InputError);
    CHECK_THROWS_WITH(decoded(".png", "P5 2 2 255 abcd", {2, 2}),
                      Catch::Contains("here: the image cannot be read"));
    for (std::size_t size = 0; size + 12 < file.size(); ++size) {
        INFO(size);
        CHECK_THROWS_AS(decoded(".png", file.substr(0, size), {2, 2}), InputError);
    }
}

}  // namespace mask_decoder_test
