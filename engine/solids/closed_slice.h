// ClosedSlice: slice of a shape whose intersection with a line has a closed form.
#pragma once

#include <vector>

#include "engine/field/slice_context.h"
#include "engine/field/tile_walk.h"

namespace lamella {

/// Rounds the intervals (mm, sorted, disjoint) of a line to runs clipped to the band, and appends them as one
/// line.
void push_intervals(const RowBand& band, std::span<const Interval> intervals, RunRows& out);

/// Returns a point in the plane from its coordinates along and across the lines.
inline dvec2 on_plane(Axis axis, double along, double across) {
    return axis == Axis::x ? dvec2(along, across) : dvec2(across, along);
}

/// Runs come from `shape.cut(axis, across, z, intervals)`, which appends the solid intervals (mm along,
/// sorted, disjoint) of the line at `across`; samples and ranges come from the field.
template <typename Shape>
class ClosedSlice : public SampledSlice {
  public:
    ClosedSlice(const Shape& shape, double z) : SampledSlice(shape, z), shape_(shape), z_(z) {}

    void runs(const RowBand& band, Scratch& /*scratch*/, RunRows& out) const override {
        out.clear();
        std::vector<Interval> intervals;
        for (int l = 0; l < band.lines(); ++l) {
            intervals.clear();
            shape_.cut(band.axis, band.line(l), z_, intervals);
            push_intervals(band, intervals, out);
        }
    }

  private:
    const Shape& shape_;
    double z_;
};

/// Returns the range over a box of a field whose value changes by at most 1 per mm.
Interval lipschitz_range(const Field& field, const Box& box);

}  // namespace lamella
