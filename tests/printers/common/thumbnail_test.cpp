// Small pictures: means of what a pixel covers, and sixteen bits a pixel.
#include "printers/common/thumbnail.h"

#include <catch2/catch.hpp>

namespace thumbnail_test {

using namespace lamella;

TEST_CASE("a shrunk picture has the means of what its pixels cover", "[thumbnail]") {
    Picture stripes{6, 6, {}};
    for (int i = 0; i < 36; ++i) {
        const auto red = static_cast<std::uint8_t>(i % 6 < 2 ? 0 : 240);
        stripes.rgb.insert(stripes.rgb.end(), {red, static_cast<std::uint8_t>(10 * (i / 6)), 100});
    }
    const Picture small = shrunk(stripes, 4);  // pixels of one and a half
    REQUIRE(small.rgb.size() == 48);
    for (int row = 0; row < 4; ++row) {
        const double green[] = {(0 + 0.5 * 10) / 1.5, (0.5 * 10 + 20) / 1.5, (30 + 0.5 * 40) / 1.5,
                                (0.5 * 40 + 50) / 1.5};
        const double red[] = {0, 240 * 2.0 / 3, 240, 240};
        for (int column = 0; column < 4; ++column) {
            const std::size_t at = 3 * static_cast<std::size_t>(4 * row + column);
            CHECK(small.rgb[at] == Approx(red[column]).margin(0.5));
            CHECK(small.rgb[at + 1] == Approx(green[row]).margin(0.5));
            CHECK(small.rgb[at + 2] == 100);
        }
    }
    CHECK(shrunk(stripes, 6).rgb == stripes.rgb);
}

TEST_CASE("sixteen bits a pixel keep the highest bits of each colour", "[thumbnail]") {
    const Picture picture{2, 1, {255, 0, 255, 0x12, 0x34, 0x56}};
    // 11111 000000 11111 and 00010 001101 01010
    CHECK(rgb565(picture) == std::string("\xf8\x1f\x11\xaa"));
}

}  // namespace thumbnail_test
