// PNG files of all kinds of pixels, packed here bit by bit, against the samples they were made of and against
// OpenImageIO.
#include "engine/io/png_reader.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <random>

namespace png_reader_test {

using namespace lamella;

namespace {

constexpr int width = 13, height = 11;
constexpr std::size_t pixels = 143;
constexpr int grey = 0, colours = 2, palette = 3, grey_alpha = 4, colours_alpha = 6;

void put_big_endian(std::string& bytes, std::uint32_t value, int count) {
    for (int shift = 8 * (count - 1); shift >= 0; shift -= 8)
        bytes += static_cast<char>(value >> shift & 255U);
}

std::string chunk(const std::string& name, const std::string& data) {
    std::string bytes;
    put_big_endian(bytes, static_cast<std::uint32_t>(data.size()), 4);
    bytes += name + data;
    const std::string checked = name + data;
    const auto crc =
        crc32(0, reinterpret_cast<const Bytef*>(checked.data()), static_cast<uInt>(checked.size()));
    put_big_endian(bytes, static_cast<std::uint32_t>(crc), 4);
    return bytes;
}

std::string deflated(const std::string& data) {
    uLongf size = compressBound(static_cast<uLong>(data.size()));
    std::string bytes(size, '\0');
    compress(reinterpret_cast<Bytef*>(bytes.data()), &size, reinterpret_cast<const Bytef*>(data.data()),
             static_cast<uLong>(data.size()));
    bytes.resize(size);
    return bytes;
}

/// A PNG file of random samples.
struct Sample {
    int type;
    int bits;
    bool transparent;
    bool interlaced;
    std::vector<std::uint32_t> samples{};  ///< as stored, channels of a pixel next to each other

    int channels() const {
        return type == colours ? 3 : type == grey_alpha ? 2 : type == colours_alpha ? 4 : 1;
    }
    std::uint32_t at(int x, int y, int channel) const {
        return samples[static_cast<std::size_t>(y * width + x) * static_cast<std::size_t>(channels()) +
                       static_cast<std::size_t>(channel)];
    }

    /// The rows of one pass, each behind the number of its filter: none.
    std::string rows(int x0, int y0, int dx, int dy) const {
        std::string bytes;
        for (int y = y0; y < height; y += dy) {
            std::string row;
            std::uint32_t open = 0;
            int filled = 0;
            for (int x = x0; x < width; x += dx) {
                for (int channel = 0; channel < channels(); ++channel) {
                    if (bits >= 8) {
                        put_big_endian(row, at(x, y, channel), bits / 8);
                        continue;
                    }
                    open = open << bits | at(x, y, channel);
                    filled += bits;
                    if (filled == 8) row += static_cast<char>(open);
                    if (filled == 8) open = 0, filled = 0;
                }
            }
            if (filled > 0) row += static_cast<char>(open << (8 - filled));
            if (x0 < width) bytes += '\0' + row;
        }
        return bytes;
    }

    std::string file() const {
        std::string header;
        put_big_endian(header, width, 4);
        put_big_endian(header, height, 4);
        for (const int number : {bits, type, 0, 0, interlaced ? 1 : 0}) header += static_cast<char>(number);
        std::string bytes = std::string(png_signature) + chunk("IHDR", header);
        if (type == palette) {
            std::string table;
            for (std::uint32_t i = 0; i < 3U << bits; ++i) table += static_cast<char>(palette_entry(i));
            bytes += chunk("PLTE", table);
        }
        if (transparent) {
            std::string marked;
            if (type == palette) {
                for (std::uint32_t i = 0; i + 1 < 1U << bits; ++i) marked += static_cast<char>(opacity(i));
            } else {
                for (int channel = 0; channel < channels(); ++channel)
                    put_big_endian(marked, at(5, 6, channel), 2);
            }
            bytes += chunk("tRNS", marked);
        }
        std::string packed;
        if (interlaced) {
            constexpr std::array<std::array<int, 4>, 7> adam7{{{0, 0, 8, 8},
                                                               {4, 0, 8, 8},
                                                               {0, 4, 4, 8},
                                                               {2, 0, 4, 4},
                                                               {0, 2, 2, 4},
                                                               {1, 0, 2, 2},
                                                               {0, 1, 1, 2}}};
            for (const auto& [x0, y0, dx, dy] : adam7) packed += rows(x0, y0, dx, dy);
        } else {
            packed = rows(0, 0, 1, 1);
        }
        return bytes + chunk("IDAT", deflated(packed)) + chunk("IEND", "");
    }

    static std::uint32_t palette_entry(std::uint32_t i) { return i * 37 + 11 & 255U; }
    std::uint32_t opacity(std::uint32_t i) const { return i + 1 < 1U << bits ? i * 53 + 7 & 255U : 255; }

    int read_channels() const {
        if (type == palette) return transparent ? 4 : 3;
        return channels() + (transparent ? 1 : 0);
    }

    /// What a reader is to return.
    std::uint32_t expected(int x, int y, int channel) const {
        const std::uint32_t most = bits == 16 ? 65535 : 255;
        if (type == palette)
            return channel < 3 ? palette_entry(3 * at(x, y, 0) + static_cast<std::uint32_t>(channel))
                               : opacity(at(x, y, 0));
        if (channel == channels()) {
            for (int c = 0; c < channels(); ++c) {
                if (at(x, y, c) != at(5, 6, c)) return most;
            }
            return 0;
        }
        return bits < 8 ? at(x, y, channel) * 255 / ((1U << bits) - 1) : at(x, y, channel);
    }
};

/// Returns files of all types and depths that there are, plain and interlaced, with a transparent colour
/// where they may have one.
std::vector<Sample> all_kinds() {
    std::mt19937 random(7);
    std::vector<Sample> kinds;
    for (const int type : {grey, colours, palette, grey_alpha, colours_alpha}) {
        for (const int bits : {1, 2, 4, 8, 16}) {
            if (bits < 8 && type != grey && type != palette) continue;
            if (bits > 8 && type == palette) continue;
            for (const bool transparent : {false, true}) {
                if (transparent && type >= grey_alpha) continue;
                for (const bool interlaced : {false, true}) {
                    Sample& kind = kinds.emplace_back(Sample{type, bits, transparent, interlaced});
                    for (int i = 0; i < width * height * kind.channels(); ++i)
                        kind.samples.push_back(static_cast<std::uint32_t>(random()) & ((1U << bits) - 1));
                }
            }
        }
    }
    return kinds;
}

template <class T>
void check_channels(ImageReader& reader, const Sample& kind) {
    for (int channel = 0; channel < kind.read_channels(); ++channel) {
        std::vector<T> samples(pixels);
        REQUIRE(reader.read_channel(channel, samples.data()).empty());
        for (int i = 0; i < width * height; ++i)
            REQUIRE(samples[static_cast<std::size_t>(i)] == kind.expected(i % width, i / width, channel));
    }
}

}  // namespace

TEST_CASE("PNG pixels of every type and depth are read", "[png]") {
    for (const Sample& kind : all_kinds()) {
        CAPTURE(kind.type, kind.bits, kind.transparent, kind.interlaced);
        const std::string file = kind.file();
        std::string why;
        const auto reader = open_png(file, why);
        REQUIRE(reader);
        const auto page = reader->next_page();
        REQUIRE(page);
        CHECK(page->width == width);
        CHECK(page->height == height);
        CHECK(page->channels == kind.read_channels());
        CHECK(page->alpha == (kind.read_channels() % 2 == 0 ? kind.read_channels() - 1 : -1));
        CHECK(page->stored_as == (kind.bits == 16 ? "uint16" : "uint8"));
        if (kind.bits == 16) {
            check_channels<std::uint16_t>(*reader, kind);
        } else {
            check_channels<std::uint8_t>(*reader, kind);
        }
        CHECK(!reader->next_page());
    }
}

TEST_CASE("PNG samples as bytes are those of OpenImageIO", "[png]") {
    for (const Sample& kind : all_kinds()) {
        CAPTURE(kind.type, kind.bits, kind.transparent, kind.interlaced);
        std::string file = kind.file(), why;
        const auto reader = open_kept_png(file, why);
        REQUIRE(reader);
        const int channels = reader->next_page()->channels;
        std::vector<std::uint8_t> ours(pixels * static_cast<std::size_t>(channels)), theirs(ours);
        REQUIRE(reader->read_bytes(ours.data()).empty());
        OIIO::Filesystem::IOMemReader memory(file.data(), file.size());
        OIIO::ImageSpec spec, config;
        config["oiio:UnassociatedAlpha"] = 1;
        const auto other = OIIO::ImageInput::create("png");
        other->set_ioproxy(&memory);
        REQUIRE(other->open("sample.png", spec, config));
        // It ignores the transparent colour of images without a palette.
        const int common = std::min(channels, spec.nchannels);
        CHECK((common == channels || (kind.transparent && kind.type != palette)));
        REQUIRE(other->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT8, theirs.data()));
        for (int i = 0; i < width * height; ++i) {
            for (int channel = 0; channel < common; ++channel)
                REQUIRE(ours[static_cast<std::size_t>(i * channels + channel)] ==
                        theirs[static_cast<std::size_t>(i * spec.nchannels + channel)]);
        }
    }
}

TEST_CASE("a damaged PNG file is refused", "[png]") {
    const std::string file = all_kinds().front().file();
    std::string why;
    CHECK(!open_png(file.substr(0, 20), why));
    CHECK(!why.empty());
    CHECK(!open_png("no image at all", why));
    CHECK(!why.empty());
    std::vector<std::uint8_t> samples(pixels);
    for (std::size_t cut = 33; cut + 12 < file.size(); ++cut) {
        const std::string part = file.substr(0, cut);
        const auto reader = open_png(part, why);
        CHECK((!reader || !reader->read_bytes(samples.data()).empty()));
    }
    for (std::size_t i = 8; i + 12 < file.size(); ++i) {
        std::string wrong = file;
        wrong[i] = static_cast<char>(wrong[i] ^ 0x10);
        const auto reader = open_png(wrong, why);
        CHECK((!reader || !reader->read_bytes(samples.data()).empty()));
    }
}

}  // namespace png_reader_test
