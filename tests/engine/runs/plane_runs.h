// Runs and volumes of a field over a box, for comparing solids line by line.
#pragma once

#include <cmath>

#include "engine/field/slice_context.h"

namespace lamella {

/// Rows along x over the box, `pitch` mm apart.
inline RowBand band_over(const Box& box, double pitch) {
    RowBand band;
    band.along_origin = box.lo.x;
    band.across_origin = box.lo.y;
    band.along_pitch = band.across_pitch = pitch;
    band.count = static_cast<int>(std::ceil(box.size().y / pitch));
    band.hi = static_cast<int>(std::ceil(box.size().x / pitch));
    return band;
}

inline RunRows runs_at(const Field& field, double z, const RowBand& band) {
    SliceContext context;
    Scratch scratch;
    RunRows rows;
    context.slice(field, z).runs(band, scratch, rows);
    return rows;
}

/// The volume of the field's part in the box, mm^3, by rows and planes `pitch` apart.
inline double volume_in(const Field& field, const Box& box, double pitch) {
    const RowBand band = band_over(box, pitch);
    const int planes = static_cast<int>(std::ceil(box.size().z / pitch));
    double units = 0;
    for (int k = 0; k < planes; ++k) {
        units += static_cast<double>(runs_at(field, box.lo.z + (k + 0.5) * pitch, band).total_length());
    }
    return units / run_unit * pitch * pitch * pitch;
}

}  // namespace lamella
