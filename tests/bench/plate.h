// The plate that the benchmarks share: an 8K display full of foam.
#pragma once

#include "engine/contours/coverage.h"
#include "engine/field/slice_context.h"
#include "engine/runs/runs.h"
#include "procedural/foam/voronoi_foam.h"

namespace lamella::bench {

inline constexpr int plate_width = 7680, plate_height = 4320;  // px
inline constexpr double plate_pixel = 0.025;                   // mm
inline constexpr double plate_z = 50;                          // mm, where it is cut

/// 192 x 108 mm of foam: cells of 4.4 mm, beams of 0.3 mm; about 5,000 beams meet a plane.
inline FoamSettings plate_foam() {
    FoamSettings settings;
    settings.cell = 4.4;
    settings.beam_radius = 0.3;
    settings.seed = 1;
    settings.region = {{0, 0, 0}, {192, 108, 100}};
    return settings;
}

/// The band of 128 pixel rows that begins at row `first`.
inline RowBand plate_band(int first, int sub) {
    RowBand band;
    band.along_pitch = plate_pixel;
    band.across_pitch = plate_pixel;
    band.first = first;
    band.count = std::min(128, plate_height - first);
    band.sub = sub;
    band.hi = plate_width;
    return band;
}

/// Makes the runs of the plate's left part, band by band; returns how many.
inline std::size_t plate_runs(const SliceField& slice, Scratch& scratch, int sub, int width = plate_width) {
    RunRows rows;
    std::size_t runs = 0;
    for (int first = 0; first < plate_height; first += 128) {
        RowBand band = plate_band(first, sub);
        band.hi = width;
        slice.runs(band, scratch, rows);
        runs += rows.runs().size();
    }
    return runs;
}

/// The grey runs of the plate's layer, `sub` lines a pixel row.
inline std::vector<GreyRun> plate_grey(int sub) {
    const auto foam = make_voronoi_foam(plate_foam());
    SliceContext context;
    const SliceField& slice = context.slice(*foam, plate_z);
    Scratch scratch;
    RunRows rows;
    std::vector<GreyRun> grey;
    for (int first = 0; first < plate_height; first += 128) {
        const RowBand band = plate_band(first, sub);
        slice.runs(band, scratch, rows);
        coverage(band, rows, grey);
    }
    return grey;
}

}  // namespace lamella::bench
