// Coverage: how much of each pixel a layer fills, as runs of equal grey values.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/field/field.h"

namespace lamella {

/// Grey value of a fully covered pixel, in images of 8 and of 16 bits per pixel.
inline constexpr int white_of_8_bits = 255, white_of_16_bits = 65535;

/// `length` consecutive pixels of one grey value: 0 when empty, `white` of the call when full.
struct GreyRun {
    std::uint32_t length;
    std::uint16_t value;
    friend bool operator==(const GreyRun&, const GreyRun&) = default;
};

/// Computes the antialiased coverage of the band's pixel rows from the runs of its sub-lines: exact along the
/// lines, the mean of `band.sub` lines across. Appends to `out`, row after row; each row sums to band.hi -
/// band.lo pixels, and a run never spans two rows. `white` is the value of full pixels.
void coverage(const RowBand& band, const RunRows& spans, std::vector<GreyRun>& out,
              int white = white_of_8_bits);

/// Computes black and white pixels: a pixel is white if its centre lies in a run of the row's only line
/// (band.sub must be 1). Appends to `out` like `coverage`.
void threshold(const RowBand& band, const RunRows& spans, std::vector<GreyRun>& out,
               int white = white_of_8_bits);

/// Computes the antialiased coverage as the area under the contour's chords, pixel by pixel: exact in both
/// directions up to the curvature within one pixel. Ignores band.sub. Appends to `out` like `coverage`.
void coverage_exact(const SliceField& slice, const RowBand& band, Scratch& scratch, std::vector<GreyRun>& out,
                    int white = white_of_8_bits);

}  // namespace lamella
