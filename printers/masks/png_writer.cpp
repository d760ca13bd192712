// Writes the PNG chunks around the compressed bands.
#include "printers/masks/png_writer.h"

#include <libdeflate.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>

#include "engine/base/error.h"
#include "printers/archive/deflate_runs.h"

namespace lamella {
namespace {

void put_u8(std::vector<std::byte>& out, unsigned value) { out.push_back(static_cast<std::byte>(value)); }

void put_u32(std::vector<std::byte>& out, std::uint32_t value) {
    for (const unsigned shift : {24U, 16U, 8U, 0U}) put_u8(out, value >> shift & 0xff);
}

void put_bytes(std::vector<std::byte>& out, std::span<const std::byte> bytes) {
    out.insert(out.end(), bytes.begin(), bytes.end());
}

std::uint32_t pixels_per_metre(double pixel) { return static_cast<std::uint32_t>(std::lround(1000 / pixel)); }

/// Appends two bytes per pixel, the higher first.
void append_pairs(std::span<const GreyRun> runs, std::vector<GreyRun>& bytes) {
    for (const GreyRun& run : runs) {
        const auto high = static_cast<std::uint16_t>(run.value >> 8U),
                   low = static_cast<std::uint16_t>(run.value & 0xffU);
        if (high == low) {
            bytes.push_back({2 * run.length, high});
            continue;
        }
        for (std::uint32_t i = 0; i < run.length; ++i) {
            bytes.push_back({1, high});
            bytes.push_back({1, low});
        }
    }
}

/// Appends rows with eight pixels per byte, the first in the highest bit. Each row starts at a new byte.
void append_bits(std::span<const GreyRun> runs, int width, std::vector<GreyRun>& bytes) {
    int column = 0;
    unsigned open = 0;  // pixels of the incomplete byte
    for (const GreyRun& run : runs) {
        const bool white = run.value > white_of_8_bits / 2;
        auto left = static_cast<int>(run.length);
        while (left > 0) {
            const int within = column % 8;
            if (within == 0 && left >= 8) {
                const int whole = left / 8;
                bytes.push_back(
                    {static_cast<std::uint32_t>(whole), static_cast<std::uint16_t>(white ? 0xff : 0)});
                column += 8 * whole;
                left -= 8 * whole;
            } else {
                const int count = std::min(left, 8 - within);
                if (white) open |= (0xffU >> within) & (0xffU << (8 - within - count));
                column += count;
                left -= count;
                if (column % 8 == 0 || column == width) {
                    bytes.push_back({1, static_cast<std::uint16_t>(open)});
                    open = 0;
                }
            }
            if (column == width) column = 0;
        }
    }
}

}  // namespace

std::size_t PngWriter::begin_chunk(const char* type) {
    const std::size_t start = out_.size();
    put_u32(out_, 0);
    for (int i = 0; i < 4; ++i) put_u8(out_, static_cast<unsigned char>(type[i]));
    return start;
}

void PngWriter::end_chunk(std::size_t start) {
    const auto length = static_cast<std::uint32_t>(out_.size() - start - 8);
    for (unsigned i = 0; i < 4; ++i) out_[start + i] = static_cast<std::byte>(length >> (24 - 8 * i));
    put_u32(out_, libdeflate_crc32(0, out_.data() + start + 4, out_.size() - start - 4));
}

PngWriter::PngWriter(const PngHeader& header, std::vector<std::byte>& out) : header_(header), out_(out) {
    if (header.width < 1 || header.width > 65535 || header.height < 1 || header.height > 65535) {
        throw InputError("an image of " + std::to_string(header.width) + " x " +
                         std::to_string(header.height) + " px: each side must be 1 to 65535");
    }
    const bool rgb = header.colors == PngColors::rgb, packed = header.colors == PngColors::packed;
    if (rgb && header.width > 65535 / 3) {
        throw InputError("an image of " + std::to_string(header.width) +
                         " px in three colours: 21845 is the most");
    }
    if (packed && header.width % 3 != 0) {
        throw InputError("an image of " + std::to_string(header.width) +
                         " px cannot be packed into colours: its width must be a multiple of 3");
    }
    if (header.bits != 8 && (header.colors != PngColors::grey || (header.bits != 1 && header.bits != 16))) {
        throw InputError(std::to_string(header.bits) + " bits a pixel: must be 8, of grey images 1, 8 or 16");
    }
    constexpr std::size_t palette_bytes = 768;  // of 256 colours
    if (!header.palette.empty() &&
        (header.palette.size() != palette_bytes || header.bits != 8 || header.colors != PngColors::grey))
        throw InputError("a palette has 256 colours, for an image with one sample of 8 bits a pixel");
    if (bytes_a_row() > 65535) {
        throw InputError("an image of " + std::to_string(header.width) + " px of 16 bits: 32767 is the most");
    }
    for (const unsigned byte : {0x89U, 0x50U, 0x4eU, 0x47U, 0x0dU, 0x0aU, 0x1aU, 0x0aU}) put_u8(out_, byte);
    const std::size_t size = begin_chunk("IHDR");
    put_u32(out_, static_cast<std::uint32_t>(packed ? header.width / 3 : header.width));
    put_u32(out_, static_cast<std::uint32_t>(header.height));
    put_u8(out_, static_cast<unsigned>(header.bits));
    put_u8(out_, !header.palette.empty() ? 3 : rgb || packed ? 2 : 0);
    put_u8(out_, 0);  // deflate
    put_u8(out_, 0);  // the five standard filters
    put_u8(out_, 0);  // not interlaced
    end_chunk(size);
    if (!header.palette.empty()) {
        const std::size_t palette = begin_chunk("PLTE");
        for (const std::uint8_t byte : header.palette) put_u8(out_, byte);
        end_chunk(palette);
    }
    // Outside these bounds (1 nm to 1 m per pixel) the number does not fit the chunk.
    const auto known = [](double pixel) { return pixel >= 1e-6 && pixel <= 1000; };
    if (known(header.pixel_x) && known(header.pixel_y)) {
        const std::size_t pitch = begin_chunk("pHYs");
        put_u32(out_, pixels_per_metre(packed ? 3 * header.pixel_x : header.pixel_x));
        put_u32(out_, pixels_per_metre(header.pixel_y));
        put_u8(out_, 1);  // the unit is the metre
        end_chunk(pitch);
    }
}

void PngWriter::add_band(std::span<const std::byte> deflated, const Adler& adler, int rows) {
    const std::size_t start = begin_chunk("IDAT");
    if (rows_ == 0) {
        put_u8(out_, 0x78);  // zlib: deflate with a window of 32 KiB
        put_u8(out_, 0x01);  // fastest level; makes the header a multiple of 31
    }
    put_bytes(out_, deflated);
    end_chunk(start);
    adler_.append(adler);
    rows_ += rows;
}

int PngWriter::bytes_a_row() const {
    if (header_.colors == PngColors::rgb) return 3 * header_.width;
    return header_.bits == 1 ? (header_.width + 7) / 8 : header_.width * header_.bits / 8;
}

void PngWriter::add_rows(std::span<const GreyRun> runs, int rows) {
    std::vector<std::byte> deflated;
    Adler adler;
    bytes_.clear();
    if (header_.colors == PngColors::rgb) {
        bytes_.assign(runs.begin(), runs.end());
        for (GreyRun& run : bytes_) run.length *= 3;
    } else if (header_.bits == 16) {
        append_pairs(runs, bytes_);
    } else if (header_.bits == 1) {
        append_bits(runs, header_.width, bytes_);
    }
    compress_band(bytes_.empty() ? runs : bytes_, bytes_a_row(), rows, deflated, adler);
    add_band(deflated, adler, rows);
}

void PngWriter::finish() {
    if (rows_ != header_.height) {
        throw FaultError("an image of " + std::to_string(header_.height) + " rows has got " +
                         std::to_string(rows_));
    }
    const std::size_t last = begin_chunk("IDAT");
    deflate_end(out_);
    put_u32(out_, adler_.value());
    end_chunk(last);
    end_chunk(begin_chunk("IEND"));
}

std::vector<std::byte> encode_png(const PngHeader& header, std::span<const GreyRun> runs) {
    std::vector<std::byte> out;
    PngWriter writer(header, out);
    const auto width = static_cast<std::uint64_t>(header.width);
    std::size_t next = 0;
    for (int row = 0; row < header.height; row += png_band_rows) {
        const int rows = std::min(png_band_rows, header.height - row);
        const std::size_t first = next;
        const std::uint64_t wanted = width * static_cast<std::uint64_t>(rows);
        const bool last = row + rows == header.height;
        for (std::uint64_t pixels = 0; next < runs.size() && (last || pixels < wanted); ++next) {
            pixels += runs[next].length;
        }
        writer.add_rows(runs.subspan(first, next - first), rows);
    }
    writer.finish();
    return out;
}

}  // namespace lamella
