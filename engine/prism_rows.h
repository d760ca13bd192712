// Runs of a triangle's prism (the triangle grown along its normal) on consecutive lines, by SIMD.
#pragma once

#include <array>
#include <cstdint>

namespace lamella {

/// Five half-planes of the layer's plane, in the frame of a reference point: along * nx + across * ny <=
/// limit; mm.
struct PrismRowParameters {
    std::array<float, 5> nx, ny, limit;
    float line0;         ///< position across of the reference line
    float line_pitch;    ///< mm from line to line
    std::int32_t first;  ///< first line, counted from the reference line
    float scale, shift;  ///< run units per mm (signed), fraction of a unit to add
    std::int32_t unit0;  ///< run unit of the reference point, floored
};

/// Writes begin and end of lines first .. first + count - 1; begin >= end where the line misses. Writes up to
/// 64 entries more.
void prism_rows(const PrismRowParameters& prism, int count, std::int32_t* begin, std::int32_t* end);

}  // namespace lamella
