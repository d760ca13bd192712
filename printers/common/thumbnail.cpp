// Resampling and encoding of small pictures.
#include "printers/common/thumbnail.h"

#include <libdeflate.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "engine/base/error.h"

namespace lamella {
namespace {

const std::uint8_t* pixel(const Picture& picture, int column, int row) {
    return picture.rgb.data() + 3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(picture.width) +
                                     static_cast<std::size_t>(column));
}

/// Returns the length of pixel [i, i + 1) that lies in [lo, hi).
double overlap(int i, double lo, double hi) {
    return std::max(0.0, std::min(hi, i + 1.0) - std::max(lo, i + 0.0));
}

void append_number(std::string& out, std::uint32_t v) {
    for (int shift = 24; shift >= 0; shift -= 8) out.push_back(static_cast<char>(v >> shift & 0xffU));
}

void append_chunk(std::string& out, const std::string& type, const std::string& data) {
    append_number(out, static_cast<std::uint32_t>(data.size()));
    const std::string checked = type + data;
    out += checked;
    append_number(out, libdeflate_crc32(0, checked.data(), checked.size()));
}

std::string compressed(const std::string& bytes, int level) {
    const std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)> compressor(
        libdeflate_alloc_compressor(level), libdeflate_free_compressor);
    if (!compressor) throw FaultError("no memory to compress a picture");
    std::string out(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()), '\0');
    out.resize(
        libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(), out.data(), out.size()));
    return out;
}

}  // namespace

Picture shrunk(const Picture& picture, int size) {
    Picture small{size, size, {}};
    const double step = static_cast<double>(picture.width) / size;
    for (int j = 0; j < size; ++j) {
        for (int i = 0; i < size; ++i) {
            double sums[3] = {0, 0, 0}, weight = 0;
            for (int y = static_cast<int>(j * step); y < std::min<double>((j + 1) * step, picture.height);
                 ++y) {
                for (int x = static_cast<int>(i * step); x < std::min<double>((i + 1) * step, picture.width);
                     ++x) {
                    const double share =
                        overlap(x, i * step, (i + 1) * step) * overlap(y, j * step, (j + 1) * step);
                    weight += share;
                    for (int k = 0; k < 3; ++k) sums[k] += share * pixel(picture, x, y)[k];
                }
            }
            for (const double sum : sums)
                small.rgb.push_back(static_cast<std::uint8_t>(std::floor(sum / weight + 0.5)));
        }
    }
    return small;
}

Picture centred(const Picture& picture, int width, int height) {
    Picture large{width, height, {}};
    const int left = (width - picture.width) / 2, top = (height - picture.height) / 2;
    for (int row = 0; row < height; ++row) {
        const int y = std::clamp(row - top, 0, picture.height - 1);
        for (int column = 0; column < width; ++column) {
            const std::uint8_t* from = pixel(picture, std::clamp(column - left, 0, picture.width - 1), y);
            large.rgb.insert(large.rgb.end(), from, from + 3);
        }
    }
    return large;
}

std::string png_file(const Picture& picture, int level) {
    std::string out("\x89PNG\r\n\x1a\n");
    std::string header;
    append_number(header, static_cast<std::uint32_t>(picture.width));
    append_number(header, static_cast<std::uint32_t>(picture.height));
    header += std::string("\x08\x02\x00\x00\x00", 5);  // 8 bits, red green blue
    append_chunk(out, "IHDR", header);
    // Each row is stored as its difference from the row above (PNG filter 2), which compresses smooth
    // backgrounds well.
    std::string rows;
    for (int row = 0; row < picture.height; ++row) {
        rows.push_back(2);
        for (int i = 0; i < 3 * picture.width; ++i) {
            const int above = row > 0 ? pixel(picture, 0, row - 1)[i] : 0;
            rows.push_back(static_cast<char>(pixel(picture, 0, row)[i] - above));
        }
    }
    append_chunk(out, "IDAT", compressed(rows, level));
    append_chunk(out, "IEND", "");
    return out;
}

std::string rgb565(const Picture& picture) {
    std::string out;
    for (std::size_t i = 0; i + 2 < picture.rgb.size(); i += 3) {
        const unsigned red = picture.rgb[i], green = picture.rgb[i + 1], blue = picture.rgb[i + 2];
        const unsigned value = (red >> 3U) << 11U | (green >> 2U) << 5U | blue >> 3U;
        out.push_back(static_cast<char>(value >> 8U));
        out.push_back(static_cast<char>(value & 0xffU));
    }
    return out;
}

}  // namespace lamella
