// The hot kernel: one beam's runs on consecutive lines, in closed form, by SIMD.
#pragma once

#include <cstdint>

namespace lamella {

/// A beam in the frame of a reference point on its axis, prepared for one plane and one set of lines. Single
/// precision is enough because every number is relative to that point; mm unless said otherwise.
struct BeamRowParameters {
    float line0;         ///< position across of line `reference line`
    float line_pitch;    ///< mm from line to line
    std::int32_t first;  ///< first line, counted from the reference line
    float ux, uy;        ///< direction of the axis along and across the lines
    float z, qz;         ///< plane's height, and its part of the axial coordinate
    float inverse_a;     ///< 1 / (cos^2 - ux^2), finite and positive
    float a;             ///< cos^2 - ux^2
    float cos2, sine;    ///< of the cone's half-angle
    float radius;        ///< at the reference point, along the cone's normal
    float low, high;     ///< axial range in which the cone's side is the surface
    float ax, ay, ah;    ///< first ball: centre along, across; radius^2 - (height over the plane)^2
    float bx, by, bh;    ///< second ball
    float scale, shift;  ///< run units per mm (signed), fraction of a unit to add
    std::int32_t unit0;  ///< run unit of the reference point, floored
};

/// Writes begin and end of lines first .. first + count - 1; begin >= end where the line misses. Writes up to
/// 64 entries more.
void beam_rows(const BeamRowParameters& beam, int count, std::int32_t* begin, std::int32_t* end);

}  // namespace lamella
