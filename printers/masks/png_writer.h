// PngWriter: encodes masks as PNG (ISO/IEC 15948) directly from runs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/contours/coverage.h"
#include "printers/archive/adler.h"

namespace lamella {

/// Samples of a pixel.
enum class PngColors : unsigned char {
    grey,    ///< one per pixel
    rgb,     ///< three per pixel, all with the pixel's grey
    packed,  ///< one per pixel; three adjacent pixels are stored as the colours of one
};

/// Size and pixel format of an image.
struct PngHeader {
    int width = 1;       ///< px, 1 to 65535
    int height = 1;      ///< px, 1 to 65535
    double pixel_x = 0;  ///< mm, for the pHYs chunk; 0 when unknown
    double pixel_y = 0;  ///< mm
    PngColors colors = PngColors::grey;
    int bits = 8;  ///< bits per sample: 8; for grey images also 1 (white from half of 255 up) and 16 (white
                   ///< is 65535)
    /// 256 colours, three bytes each, that the samples of an image of 8 bits number; empty: they are greys.
    std::vector<std::uint8_t> palette{};
};

/// Writes one image band by band, each band as an IDAT chunk. Memory: the compressed bytes and one band.
class PngWriter {
  public:
    /// Starts an image at the end of `out`, which must outlive the writer. Throws InputError for a size out
    /// of range: a row has at most 65535 samples, and a multiple of 3 if they are packed.
    PngWriter(const PngHeader& header, std::vector<std::byte>& out);
    /// Appends `rows` rows. Their runs are in order; those of each row sum to the width.
    void add_rows(std::span<const GreyRun> runs, int rows);
    /// Appends a band that was compressed by compress_band, possibly on another thread.
    void add_band(std::span<const std::byte> deflated, const Adler& adler, int rows);
    /// Ends the image. Throws FaultError unless all rows were added.
    void finish();

  private:
    std::size_t begin_chunk(const char* type);
    void end_chunk(std::size_t start);
    int bytes_a_row() const;

    PngHeader header_;
    std::vector<std::byte>& out_;
    Adler adler_;
    std::vector<GreyRun> bytes_;  ///< runs of a row's bytes, if these differ from its pixels
    int rows_ = 0;
};

/// Number of rows that are compressed together.
inline constexpr int png_band_rows = 128;

/// Encodes a whole image from the runs of its rows.
std::vector<std::byte> encode_png(const PngHeader& header, std::span<const GreyRun> runs);

}  // namespace lamella
