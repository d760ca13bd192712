// PNG files of masks, written from runs (ISO/IEC 15948).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "engine/contours/coverage.h"
#include "printers/archive/adler.h"

namespace lamella {

/// What the samples of a row are.
enum class PngColors : unsigned char {
    grey,    ///< one a pixel
    rgb,     ///< a pixel's grey in each of its three colours
    packed,  ///< three pixels side by side are the colours of one
};

/// Size of an image.
struct PngHeader {
    int width = 1;       ///< px, 1 to 65535
    int height = 1;      ///< px, 1 to 65535
    double pixel_x = 0;  ///< mm, for the pHYs chunk; 0 when unknown
    double pixel_y = 0;  ///< mm
    PngColors colors = PngColors::grey;
    int bits = 8;  ///< a sample: 8; of grey images also 1 (white from half of 255 on) and 16 (white is 65535)
};

/// Writes one image band by band, each band an IDAT chunk. Memory: the compressed bytes and one band.
class PngWriter {
  public:
    /// Starts an image at the end of `out`, which must outlive the writer. Throws InputError for a size
    /// out of range: the samples of a row are 65535 at most, and those that are packed a multiple of 3.
    PngWriter(const PngHeader& header, std::vector<std::byte>& out);
    /// Adds `rows` rows; their runs follow each other and sum to the width each.
    void add_rows(std::span<const GreyRun> runs, int rows);
    /// Adds a band that compress_band made, perhaps on another thread.
    void add_band(std::span<const std::byte> deflated, const Adler& adler, int rows);
    /// Ends the image. Throws FaultError unless it has got all of its rows.
    void finish();

  private:
    std::size_t begin_chunk(const char* type);
    void end_chunk(std::size_t start);
    int bytes_a_row() const;

    PngHeader header_;
    std::vector<std::byte>& out_;
    Adler adler_;
    std::vector<GreyRun> bytes_;  ///< runs of a row's bytes, where those are not its pixels
    int rows_ = 0;
};

/// Rows that are compressed together.
inline constexpr int png_band_rows = 128;

/// A whole image from the runs of its rows.
std::vector<std::byte> encode_png(const PngHeader& header, std::span<const GreyRun> runs);

}  // namespace lamella
