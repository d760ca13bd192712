// GOO files hold the masks of a stack, by a decoder that knows nothing of the encoder.
#include "printers/masks/goo.h"

#include <bit>
#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "printers/masks/goo_rle.h"
#include "printers/masks/png_stack.h"
#include "tests/printers/common/plane_solids.h"
#include "tests/printers/masks/decode_image.h"

namespace goo_test {

using namespace lamella;
using namespace lamella::test;

namespace {

Job cone(int layers = 15) {
    return make_job(
        {{-6, -6, 0}, {6, 6, layers * 0.5}},
        [](double z) {
            return std::vector<Figure>{disc({0.3, -0.2}, 5.5 / (1 + z * 0.3))};
        },
        0.5);
}

PrinterProfile small_machine(bool portrait) {
    PrinterProfile profile;
    profile.image.width = 300;
    profile.image.height = 280;
    profile.image.portrait = portrait;
    return profile;
}

/// Reads numbers with their highest byte first.
class Reader {
  public:
    explicit Reader(std::string text) : text_(std::move(text)) {}
    std::uint32_t number(int bytes) {
        std::uint32_t value = 0;
        while (bytes-- > 0) value = value << 8U | static_cast<unsigned char>(text_.at(at_++));
        return value;
    }
    double real() { return std::bit_cast<float>(number(4)); }
    std::string raw(std::size_t bytes) {
        REQUIRE(at_ + bytes <= text_.size());
        at_ += bytes;
        return text_.substr(at_ - bytes, bytes);
    }
    std::string text(std::size_t bytes) { return raw(bytes).c_str(); }
    std::size_t at() const { return at_; }
    bool done() const { return at_ == text_.size(); }

  private:
    std::string text_;
    std::size_t at_ = 0;
};

/// All chunks of the specification, differences included.
std::vector<std::uint8_t> decode(const std::string& code) {
    const auto byte = [&](std::size_t i) -> unsigned { return static_cast<unsigned char>(code.at(i)); };
    REQUIRE(byte(0) == 0x55);
    unsigned sum = 0;
    for (std::size_t i = 1; i + 1 < code.size(); ++i) sum += byte(i);
    CHECK(byte(code.size() - 1) == (~sum & 0xffU));
    std::vector<std::uint8_t> pixels;
    unsigned value = 0;
    for (std::size_t i = 1; i + 1 < code.size();) {
        const unsigned head = byte(i++), type = head >> 6U;
        std::size_t length = 1;
        if (type == 2) {
            const unsigned step = head & 0xfU;
            value = (head & 0x20U) != 0 ? value - step : value + step;
            if ((head & 0x10U) != 0) length = byte(i++);
        } else {
            if (type == 0) value = 0;
            if (type == 3) value = 255;
            if (type == 1) value = byte(i++);
            std::size_t high = 0;
            for (unsigned more = head >> 4U & 3U; more > 0; --more) high = high << 8U | byte(i++);
            length = high << 4U | (head & 0xfU);
        }
        pixels.insert(pixels.end(), length, static_cast<std::uint8_t>(value));
    }
    return pixels;
}

struct GooLayer {
    double z, exposure;
    std::vector<std::uint8_t> pixels;
};

struct GooFile {
    std::uint32_t layers, width, height, seconds;
    double size_x, size_y, thickness, volume;
    std::vector<GooLayer> list;
};

GooFile read_goo(const std::string& path) {
    Reader in(read_text(path));
    CHECK(in.raw(4) == "V3.0");
    const std::string magic = in.raw(8);
    CHECK(magic == std::string("\x07\0\0\0DLP\0", 8));
    CHECK(in.text(32) == "Lamella");
    in.raw(24 + 24 + 32 + 32 + 32 + 6);
    in.raw(std::size_t{116} * 116 * 2);
    CHECK(in.raw(2) == "\r\n");
    in.raw(std::size_t{290} * 290 * 2);
    CHECK(in.raw(2) == "\r\n");
    GooFile file{};
    file.layers = in.number(4);
    file.width = in.number(2);
    file.height = in.number(2);
    in.number(2);
    file.size_x = in.real();
    file.size_y = in.real();
    in.real();
    file.thickness = in.real();
    in.raw(4 + 1 + 7 * 4 + 4 + 4 + 16 * 4 + 4);
    CHECK(in.number(1) == 1);
    file.seconds = in.number(4);
    file.volume = in.real();
    in.raw(4 + 4 + 8);
    CHECK(in.number(4) == goo_header_size);
    CHECK(in.number(1) == 1);
    in.number(2);
    REQUIRE(in.at() == goo_header_size);
    for (std::uint32_t k = 0; k < file.layers; ++k) {
        GooLayer layer{};
        in.raw(6);
        layer.z = in.real();
        layer.exposure = in.real();
        in.raw(48);
        CHECK(in.number(2) == 255);
        CHECK(in.raw(2) == "\r\n");
        layer.pixels = decode(in.raw(in.number(4)));
        CHECK(in.raw(2) == "\r\n");
        file.list.push_back(std::move(layer));
    }
    CHECK(in.raw(3) == std::string(3, '\0'));
    CHECK(in.raw(8) == magic);
    CHECK(in.done());
    return file;
}

}  // namespace

TEST_CASE("a GOO file holds the masks of a stack, grey for grey", "[goo]") {
    for (const bool portrait : {false, true}) {
        const TemporaryFolder folder;
        const PrinterProfile profile = small_machine(portrait);
        const double volume = run_layers(cone(), *make_goo(profile, folder / "a.goo", false), {0, 15});
        run_layers(cone(), *make_png_stack(profile, folder / "stack", false), {0, 15});
        const GooFile file = read_goo(folder / "a.goo");
        REQUIRE(file.layers == 15);
        CHECK(file.width == (portrait ? 280 : 300));
        CHECK(file.height == (portrait ? 300 : 280));
        CHECK(file.size_x == Approx(file.width * 0.05));
        CHECK(file.size_y == Approx(file.height * 0.05));
        CHECK(file.thickness == Approx(0.5));
        CHECK(file.volume == Approx(volume).epsilon(1e-5));
        for (std::size_t k = 0; k < 15; ++k) {
            const std::string number = std::to_string(100000 + k).substr(1);
            const DecodedImage png = decode_image(folder / ("stack/" + number + ".png"));
            CHECK(file.list[k].pixels == png.pixels);
            CHECK(file.list[k].z == Approx(0.5 * static_cast<double>(k + 1)));
        }
        // Four layers of 25 s, a ramp of ten, one of 2.5 s, and 6 s of moves each.
        CHECK(file.list[3].exposure == Approx(25));
        CHECK(file.list[4].exposure == Approx(25 - 22.5 / 11));
        CHECK(file.list[14].exposure == Approx(2.5));
        CHECK(file.seconds == static_cast<std::uint32_t>(4 * 25 + 10 * 13.75 + 2.5 + 15 * 6));
    }
}

TEST_CASE("runs of every length come back", "[goo]") {
    std::vector<GreyRun> runs;
    std::vector<std::uint8_t> pixels;
    for (const std::uint32_t length : {1U, 15U, 16U, 17U, 4095U, 4096U, 1048575U, 1048576U}) {
        for (const std::uint8_t value :
             {std::uint8_t{0}, std::uint8_t{255}, std::uint8_t{1}, std::uint8_t{254}}) {
            runs.push_back({length, value});
            pixels.insert(pixels.end(), length, value);
        }
    }
    GooEncoder encoder;
    for (const GreyRun& run : runs) encoder.add({&run, 1});
    const std::vector<std::byte> code = encoder.finish();
    CHECK(decode({reinterpret_cast<const char*>(code.data()), code.size()}) == pixels);
}

TEST_CASE("equal runs are joined, and a black layer takes few bytes", "[goo]") {
    GooEncoder encoder;
    for (int row = 0; row < 1000; ++row) encoder.add(std::vector<GreyRun>{{1000, 0}});
    CHECK(encoder.finish().size() == 1 + 3 + 1);
}

TEST_CASE("a stopped GOO file is continued to the same bytes", "[goo]") {
    const TemporaryFolder folder;
    run_layers(cone(), *make_goo(small_machine(true), folder / "whole.goo", false), {0, 15});
    for (const int stop : {0, 1, 8}) {
        const std::string part = folder / ("part" + std::to_string(stop));
        run_layers(cone(), *make_goo(small_machine(true), part, false), {0, 15}, false, stop);
        write_text(part + ".partial", read_text(part + ".partial") + "half a layer");
        run_layers(cone(), *make_goo(small_machine(true), part, false), {0, 15}, true);
        CHECK(read_text(part) == read_text(folder / "whole.goo"));
    }
}

}  // namespace goo_test
