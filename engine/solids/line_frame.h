// Conversion from a band of lines to the frame of the row kernels.
#pragma once

#include "engine/runs/runs.h"
#include "engine/solids/row_kernels.h"

namespace lamella {

/// Lines [first, last) of a band, numbered from the band's first line.
struct LineRange {
    int first;
    int last;
};

/// Returns the lines of the band that an interval across the lines meets.
inline LineRange lines_across(const RowBand& band, const Interval& across) {
    const double per_mm = band.sub / band.across_pitch;
    const double p = (across.lo - band.across_origin) * per_mm, q = (across.hi - band.across_origin) * per_mm;
    const double offset = band.number(0) + 0.5, step = band.step;
    const double lo = std::ceil((std::min(p, q) - offset) / step),
                 hi = std::floor((std::max(p, q) - offset) / step) + 1;
    const double lines = band.lines();
    return {static_cast<int>(std::min(std::max(lo, 0.0), lines)),
            static_cast<int>(std::min(std::max(hi, 0.0), lines))};
}

/// Returns the lines of the band from line `first` on, relative to a reference point. The reference line is
/// counted from row 0 of the whole layer, so that a line gives the same run in every band.
inline LineFrame line_frame(const RowBand& band, int first, dvec2 reference) {
    const int along = band.axis == Axis::x ? 0 : 1, across = 1 - along;
    const double pitch = band.across_pitch / band.sub;
    const double line = std::floor((reference[across] - band.across_origin) / pitch - 0.5);
    const double position = band.across_origin + (line + 0.5) * pitch;
    const double unit = band.coordinate(reference[along]), unit0 = std::floor(unit);
    static constexpr double limit = 1e9;
    const auto clamped = [](double v) {
        return static_cast<std::int32_t>(std::min(std::max(v, -limit), limit));
    };
    return {.line0 = static_cast<float>(position - reference[across]),
            .line_pitch = static_cast<float>(pitch),
            .first = clamped(band.number(first) - line),
            .step = band.step,
            .scale = static_cast<float>(run_unit / band.along_pitch),
            .shift = static_cast<float>(unit - unit0),
            .unit0 = clamped(unit0)};
}

}  // namespace lamella
