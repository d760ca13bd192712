// What every slice has to give: runs in order within their band, in both directions.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "engine/field/field.h"
#include "engine/field/slice_context.h"

namespace lamella {

/// Aborts unless the runs of 16 rows and 16 columns over the rectangle are sorted, disjoint and clipped.
inline void check_runs(const SliceField& slice, const Rect& rect, Scratch& scratch) {
    constexpr int pixels = 16;
    constexpr double least_pitch = 1e-9;  // mm
    for (const Axis axis : {Axis::x, Axis::y}) {
        const int along = axis == Axis::x ? 0 : 1;
        RowBand band;
        band.axis = axis;
        band.along_origin = rect.lo[along];
        band.along_pitch = std::max(rect.size()[along] / pixels, least_pitch);
        band.across_origin = rect.lo[1 - along];
        band.across_pitch = std::max(rect.size()[1 - along] / pixels, least_pitch);
        band.count = band.hi = pixels;
        band.sub = 2;
        RunRows rows;
        slice.runs(band, scratch, rows);
        if (rows.lines() != static_cast<std::size_t>(band.lines())) std::abort();
        for (std::size_t line = 0; line < rows.lines(); ++line) {
            std::int32_t last = -1;
            for (const Run& run : rows.line(line)) {
                if (run.begin <= last || run.end <= run.begin || run.end > pixels * run_unit) std::abort();
                last = run.end;
            }
        }
    }
}

}  // namespace lamella
