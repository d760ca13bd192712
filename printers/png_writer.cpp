// PNG chunks round the deflated bands.
#include "printers/png_writer.h"

#include <libdeflate.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>

#include "engine/error.h"
#include "printers/deflate_runs.h"

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
    for (const unsigned byte : {0x89U, 0x50U, 0x4eU, 0x47U, 0x0dU, 0x0aU, 0x1aU, 0x0aU}) put_u8(out_, byte);
    const std::size_t size = begin_chunk("IHDR");
    put_u32(out_, static_cast<std::uint32_t>(packed ? header.width / 3 : header.width));
    put_u32(out_, static_cast<std::uint32_t>(header.height));
    put_u8(out_, 8);  // bits a sample
    put_u8(out_, rgb || packed ? 2 : 0);
    put_u8(out_, 0);  // deflate
    put_u8(out_, 0);  // the five standard filters
    put_u8(out_, 0);  // not interlaced
    end_chunk(size);
    // Beyond these bounds (1 nm to 1 m a pixel) the chunk could not hold the number.
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
        put_u8(out_, 0x01);  // fastest; makes the header a multiple of 31
    }
    put_bytes(out_, deflated);
    end_chunk(start);
    adler_.append(adler);
    rows_ += rows;
}

void PngWriter::add_rows(std::span<const GreyRun> runs, int rows) {
    std::vector<std::byte> deflated;
    Adler adler;
    if (header_.colors == PngColors::rgb) {
        tripled_.assign(runs.begin(), runs.end());
        for (GreyRun& run : tripled_) run.length *= 3;
        compress_band(tripled_, 3 * header_.width, rows, deflated, adler);
    } else {
        compress_band(runs, header_.width, rows, deflated, adler);
    }
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
