// Rounds closed-form intervals to runs.
#include "engine/solids/closed_slice.h"

namespace lamella {

void push_intervals(const RowBand& band, std::span<const Interval> intervals, RunRows& out) {
    const std::int32_t lo = band.lo * run_unit, hi = band.hi * run_unit;
    const auto push = [&](const Interval& interval) {
        const double u = band.coordinate(interval.lo), v = band.coordinate(interval.hi);
        out.push(std::max(lo, round_run(std::min(u, v))), std::min(hi, round_run(std::max(u, v))));
    };
    if (band.along_pitch > 0) {
        for (const Interval& interval : intervals) push(interval);
    } else {
        for (std::size_t i = intervals.size(); i-- > 0;) push(intervals[i]);
    }
    out.end_line();
}

Interval lipschitz_range(const Field& field, const Box& box) {
    const dvec3 half = box.size() * 0.5;
    const double reach = std::sqrt(half.x * half.x + half.y * half.y + half.z * half.z);
    if (!std::isfinite(reach)) return {-infinity, infinity};
    const double v = field.value(box.center());
    if (std::isnan(v)) return {-infinity, infinity};
    return {v - reach, v + reach};
}

}  // namespace lamella
