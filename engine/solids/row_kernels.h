// SIMD kernels in closed form: the runs of one beam or one prism on consecutive lines. The innermost loops of
// slicing.
#pragma once

#include <array>
#include <cstdint>

namespace lamella {

/// The lines of a band relative to a reference point. Single precision is enough, because all numbers in a
/// kernel are relative to that point; lengths in mm.
struct LineFrame {
    float line0;         ///< from the point to the reference line, across
    float line_pitch;    ///< from a line to the one with the next number
    std::int32_t first;  ///< first line to compute, counted from the reference line
    std::int32_t step;   ///< from one line to compute to the next
    float scale;         ///< run units per mm (negative in a mirrored band)
    float shift;         ///< fraction of a run unit to add
    std::int32_t unit0;  ///< run unit of the point, floored
};

/// A beam in the frame of a reference point on its axis, prepared for one plane.
struct BeamInPlane {
    float ux, uy;        ///< direction of the axis along and across the lines
    float z, qz;         ///< the plane's height, and its part of the axial coordinate
    float a, inverse_a;  ///< cos^2 - ux^2 of the cone's half-angle, positive, and 1 over it
    float cos2, sine;    ///< of the cone's half-angle
    float radius;        ///< at the reference point, along the cone's normal
    float low, high;     ///< axial range in which the cone's side is the surface
    float ax, ay, ah;    ///< first ball: centre along, across; radius^2 - (height over the plane)^2
    float bx, by, bh;    ///< second ball
};

/// A triangle dilated along its normal, cut by a plane: along * nx + across * ny <= limit for five
/// half-planes, and low <= along <= high.
struct PrismInPlane {
    std::array<float, 5> nx, ny, limit;
    float low, high;
};

/// Write begin and end of the runs on `count` lines; begin >= end where the line misses the shape. They may
/// overwrite up to RunCollector::slack entries more.
void beam_rows(const LineFrame& frame, const BeamInPlane& beam, int count, std::int32_t* begin,
               std::int32_t* end);
void prism_rows(const LineFrame& frame, const PrismInPlane& prism, int count, std::int32_t* begin,
                std::int32_t* end);

}  // namespace lamella
