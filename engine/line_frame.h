// Lines of a band counted from a reference point, so that single-precision kernels keep every digit.
#pragma once

#include "engine/runs.h"

namespace lamella {

/// Lines [first, last) of a band, counted from its first line.
struct LineRange {
    int first;
    int last;
};

/// The lines of the band that an interval across meets.
inline LineRange lines_across(const RowBand& band, const Interval& across) {
    const double per_mm = band.sub / band.across_pitch;
    const double p = (across.lo - band.across_origin) * per_mm, q = (across.hi - band.across_origin) * per_mm;
    const double offset = static_cast<double>(band.first) * band.sub + 0.5;
    const double lo = std::ceil(std::min(p, q) - offset), hi = std::floor(std::max(p, q) - offset) + 1;
    const double lines = band.lines();
    return {static_cast<int>(std::min(std::max(lo, 0.0), lines)),
            static_cast<int>(std::min(std::max(hi, 0.0), lines))};
}

/// Coordinates relative to a reference point. The reference line is counted from row 0 of the whole layer, so
/// that a line gives the same run in whichever band it is asked for.
struct LineFrame {
    double line0;        ///< mm across from the point to the reference line
    double line_pitch;   ///< mm from line to line
    std::int32_t first;  ///< first line of the band, counted from the reference line
    double scale;        ///< run units per mm
    double shift;        ///< fraction of a run unit to add
    std::int32_t unit0;  ///< run unit of the point, floored
};

inline LineFrame line_frame(const RowBand& band, dvec2 reference) {
    const int along = band.axis == Axis::x ? 0 : 1, across = 1 - along;
    const double pitch = band.across_pitch / band.sub;
    const double line = std::floor((reference[across] - band.across_origin) / pitch - 0.5);
    const double position = band.across_origin + (line + 0.5) * pitch;
    const double unit = band.coordinate(reference[along]), unit0 = std::floor(unit);
    static constexpr double limit = 1e9;
    const auto clamped = [](double v) {
        return static_cast<std::int32_t>(std::min(std::max(v, -limit), limit));
    };
    return {position - reference[across],
            pitch,
            clamped(static_cast<double>(band.first) * band.sub - line),
            run_unit / band.along_pitch,
            unit - unit0,
            clamped(unit0)};
}

}  // namespace lamella
