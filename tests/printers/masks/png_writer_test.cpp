// PNG files written from runs decode to exactly the pixels of the runs, whatever these are.
#include "printers/masks/png_writer.h"

#include <OpenImageIO/imageio.h>
#include <unistd.h>
#include <zlib.h>

#include <catch2/catch.hpp>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>

#include "engine/base/error.h"
#include "printers/archive/deflate_runs.h"
#include "tests/printers/masks/decode_image.h"

namespace png_writer_test {

using namespace lamella;

namespace {

struct Mask {
    int width = 0;
    int height = 0;
    std::vector<GreyRun> runs;
};

std::vector<unsigned char> expand(const Mask& mask) {
    std::vector<unsigned char> pixels;
    for (const GreyRun& run : mask.runs)
        pixels.insert(pixels.end(), run.length, static_cast<unsigned char>(run.value));
    return pixels;
}

std::uint32_t big_endian(const std::vector<std::byte>& bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8 | std::to_integer<std::uint32_t>(bytes[at + i]);
    return value;
}

/// Joins the IDAT chunks, checking every chunk's checksum with zlib.
std::vector<unsigned char> image_data(const std::vector<std::byte>& png) {
    std::vector<unsigned char> data;
    std::size_t at = 8;
    bool ended = false;
    while (at + 12 <= png.size()) {
        const std::uint32_t length = big_endian(png, at);
        REQUIRE(at + 12 + length <= png.size());
        const auto* chunk = reinterpret_cast<const unsigned char*>(png.data()) + at + 4;
        REQUIRE(crc32(0, chunk, length + 4) == big_endian(png, at + 8 + length));
        if (std::memcmp(chunk, "IDAT", 4) == 0) data.insert(data.end(), chunk + 4, chunk + 4 + length);
        ended = std::memcmp(chunk, "IEND", 4) == 0;
        at += 12 + length;
    }
    REQUIRE(ended);
    REQUIRE(at == png.size());
    return data;
}

/// Inflates with zlib, which also checks the Adler-32, and compares with the rows byte for byte.
void check_with_zlib(const Mask& mask, const std::vector<std::byte>& png) {
    std::vector<unsigned char> data = image_data(png);
    const auto width = static_cast<std::size_t>(mask.width);
    const auto height = static_cast<std::size_t>(mask.height);
    std::vector<unsigned char> rows((width + 1) * height + 1);
    auto length = static_cast<uLongf>(rows.size());
    auto taken = static_cast<uLong>(data.size());
    REQUIRE(uncompress2(rows.data(), &length, data.data(), &taken) == Z_OK);
    REQUIRE(taken == data.size());
    REQUIRE(length == (width + 1) * height);
    const std::vector<unsigned char> pixels = expand(mask);
    REQUIRE(pixels.size() == width * height);
    bool same = true;
    for (std::size_t y = 0; y < height; ++y) {
        same = same && rows[y * (width + 1)] == 0 &&
               std::memcmp(&rows[y * (width + 1) + 1], &pixels[y * width], width) == 0;
    }
    REQUIRE(same);
}

void check_with_oiio(const Mask& mask, const std::vector<std::byte>& png) {
    const DecodedImage image = decode_image(png);
    REQUIRE(image.width == mask.width);
    REQUIRE(image.height == mask.height);
    REQUIRE(image.pixels == expand(mask));
}

std::vector<std::byte> check(const Mask& mask) {
    INFO(mask.width << " x " << mask.height);
    const std::vector<std::byte> png = encode_png({mask.width, mask.height, 0.05, 0.04}, mask.runs);
    check_with_zlib(mask, png);
    check_with_oiio(mask, png);
    return png;
}

/// Rows cut into runs whose mean length is `mean`, of `greys` values.
Mask random_mask(int width, int height, double mean, int greys, std::mt19937& random) {
    Mask mask{width, height, {}};
    std::geometric_distribution<std::uint32_t> length(1 / mean);
    std::uniform_int_distribution<int> grey(0, greys - 1);
    for (int y = 0; y < height; ++y) {
        for (auto left = static_cast<std::uint32_t>(width); left > 0;) {
            const std::uint32_t n = std::min(left, 1 + length(random));
            mask.runs.push_back({n, static_cast<std::uint8_t>(grey(random) * 255 / std::max(greys - 1, 1))});
            left -= n;
        }
    }
    return mask;
}

Mask flat(int width, int height, std::uint8_t value) {
    return {
        width, height,
        std::vector<GreyRun>(static_cast<std::size_t>(height), {static_cast<std::uint32_t>(width), value})};
}

}  // namespace

TEST_CASE("a pixel is a colour's three samples, or three pixels are", "[png]") {
    std::mt19937 random(5);
    const Mask mask = random_mask(99, 70, 4, 256, random);
    const std::vector<unsigned char> greys = expand(mask);
    for (const PngColors colors : {PngColors::rgb, PngColors::packed}) {
        std::vector<std::byte> png;
        PngWriter writer({99, 70, 0.05, 0.05, colors}, png);
        writer.add_rows(mask.runs, 70);
        writer.finish();
        OIIO::Filesystem::IOMemReader memory(png.data(), png.size());
        const auto input = OIIO::ImageInput::open("memory.png", nullptr, &memory);
        REQUIRE(input);
        const bool packed = colors == PngColors::packed;
        REQUIRE(input->spec().width == (packed ? 33 : 99));
        REQUIRE(input->spec().nchannels == 3);
        std::vector<unsigned char> samples(std::size_t{packed ? 33U : 99U} * 70 * 3);
        REQUIRE(input->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, samples.data()));
        if (packed) {
            CHECK((samples == greys));
        } else {
            std::vector<unsigned char> tripled;
            for (const unsigned char grey : greys) tripled.insert(tripled.end(), 3, grey);
            CHECK((samples == tripled));
        }
    }
}

TEST_CASE("a flat image decodes at every awkward size", "[png]") {
    for (const int width : {1, 2, 3, 4, 5, 257, 258, 259, 260, 261, 262, 517, 519, 1000}) {
        for (const int height : {1, 2, 63, 64, 65, 128, 130}) {
            check(flat(width, height, 0));
            check(flat(width, height, 255));
            check(flat(width, height, 7));
        }
    }
}

TEST_CASE("an image of one pixel decodes", "[png]") { check({1, 1, {{1, 200}}}); }

TEST_CASE("an 8K mask that is empty costs about the least that deflate allows", "[png]") {
    const std::vector<std::byte> png = check(flat(7680, 4320, 0));
    const double bytes = 7681.0 * 4320;
    CHECK(static_cast<double>(png.size()) < bytes / 1032 + 68 * 60);
}

TEST_CASE("the widest and the highest image decode", "[png]") {
    check(flat(65535, 3, 255));
    check(flat(3, 65535, 255));
    std::mt19937 random(4);
    check(random_mask(65535, 70, 3000, 256, random));
    check(random_mask(1, 65535, 1, 2, random));
}

TEST_CASE("noise decodes, and costs hardly more than its bytes", "[png]") {
    std::mt19937 random(5);
    const Mask mask = random_mask(1000, 500, 1.001, 256, random);
    CHECK(static_cast<double>(check(mask).size()) < 1.02 * 1000 * 500);
}

TEST_CASE("random runs decode", "[png]") {
    const unsigned seed = GENERATE(range(1U, 61U));
    INFO("seed " << seed);
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> side(1, 700);
    std::uniform_real_distribution<double> mean(1.01, 400);
    const int greys = std::uniform_int_distribution<int>(1, 256)(random);
    const int width = side(random);
    check(random_mask(width, side(random) / 3 + 1, mean(random), greys, random));
}

TEST_CASE("runs of every length decode, also those that go on over many rows", "[png]") {
    constexpr std::uint32_t longest = 2000, black_rows = 200;
    Mask mask{longest, longest / 2 + black_rows, {}};
    for (std::uint32_t length = 1; length <= longest / 2; ++length) {
        mask.runs.push_back({length, 255});
        mask.runs.push_back({longest - length, static_cast<std::uint16_t>(length % 2)});
    }
    for (std::uint32_t row = 1; row < black_rows; ++row) mask.runs.push_back({longest, 0});
    mask.runs.push_back({longest - 1, 0});
    mask.runs.push_back({1, 255});
    check(mask);
}

TEST_CASE("rows that repeat are stored as copies", "[png]") {
    std::mt19937 random(9);
    for (const int width : {40, 258, 517, 3000, 32767, 32768, 40000}) {
        Mask mask = random_mask(width, 1, 2, 256, random);
        const std::vector<GreyRun> row = mask.runs;
        for (; mask.height < 100; ++mask.height) {
            // Every 30th row differs in its last pixel, so that copies begin and end inside a band.
            std::vector<GreyRun> next = row;
            if (mask.height % 30 == 29) next.back().value ^= 255;
            mask.runs.insert(mask.runs.end(), next.begin(), next.end());
        }
        const std::size_t size = check(mask).size();
        if (width <= 32767) CHECK(size < static_cast<std::size_t>(width) * 9 + 8000);
    }
}

TEST_CASE("skewed frequencies do not break the code length limit", "[png]") {
    // Frequencies that grow like Fibonacci numbers make the longest possible Huffman codes.
    Mask mask{1, 0, {}};
    std::uint32_t a = 1;
    std::uint32_t b = 1;
    std::vector<std::uint8_t> values;
    for (std::uint8_t value = 1; value < 26; ++value) {
        values.insert(values.end(), a, value);
        b = std::exchange(a, a + b);
    }
    std::mt19937 random(3);
    std::shuffle(values.begin(), values.end(), random);
    mask.width = 5000;
    mask.height = static_cast<int>(values.size() / 5000);
    for (int i = 0; i < mask.width * mask.height; ++i)
        mask.runs.push_back({1, values[static_cast<std::size_t>(i)]});
    check(mask);
}

TEST_CASE("bands made apart join to the same file", "[png]") {
    std::mt19937 random(11);
    const Mask mask = random_mask(333, 200, 20, 16, random);
    const std::vector<std::byte> whole = encode_png({333, 200, 0, 0}, mask.runs);
    std::vector<std::byte> joined;
    PngWriter writer({333, 200, 0, 0}, joined);
    std::size_t next = 0;
    for (int row = 0; row < 200; row += png_band_rows) {
        const int rows = std::min(png_band_rows, 200 - row);
        const std::size_t first = next;
        for (int pixels = 0; pixels < 333 * rows; ++next) pixels += static_cast<int>(mask.runs[next].length);
        std::vector<std::byte> band;
        Adler adler;
        compress_band(std::span(mask.runs).subspan(first, next - first), 333, rows, band, adler);
        writer.add_band(band, adler, rows);
    }
    writer.finish();
    CHECK(joined == whole);
}

TEST_CASE("runs that do not fill their rows are refused", "[png]") {
    std::vector<std::byte> out;
    Adler adler;
    const std::vector<GreyRun> short_row = {{4, 0}, {5, 255}};
    CHECK_THROWS_AS(compress_band(short_row, 10, 1, out, adler), FaultError);
    const std::vector<GreyRun> long_row = {{4, 0}, {7, 255}};
    CHECK_THROWS_AS(compress_band(long_row, 10, 1, out, adler), FaultError);
    const std::vector<GreyRun> two_rows = {{20, 0}};
    CHECK_THROWS_AS(compress_band(two_rows, 10, 2, out, adler), FaultError);
    const std::vector<GreyRun> too_many = {{10, 0}, {10, 0}};
    CHECK_THROWS_AS(compress_band(too_many, 10, 1, out, adler), FaultError);
    CHECK_THROWS_AS(encode_png({10, 3, 0, 0}, too_many), FaultError);
    CHECK_THROWS_AS(encode_png({0, 1, 0, 0}, {}), InputError);
    CHECK_THROWS_AS(encode_png({1, 65536, 0, 0}, {}), InputError);
}

TEST_CASE("the pixel pitch stands in the file", "[png]") {
    const DecodedImage image = decode_image(encode_png({2, 1, 0.05, 0.04}, std::vector<GreyRun>{{2, 9}}));
    CHECK(image.pixels_per_metre_x == 20000);
    CHECK(image.pixels_per_metre_y == 25000);
}

}  // namespace png_writer_test
