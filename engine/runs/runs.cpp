// Geometry of bands; copying, summing and packing of runs.
#include "engine/runs/runs.h"

#include <algorithm>

#include "engine/base/archive.h"

namespace lamella {

Rect RowBand::rect() const {
    const double u0 = along(static_cast<double>(lo) * run_unit),
                 u1 = along(static_cast<double>(hi) * run_unit);
    const double v0 = across_origin + first * across_pitch,
                 v1 = across_origin + (first + count) * across_pitch;
    const Interval u{std::min(u0, u1), std::max(u0, u1)}, v{std::min(v0, v1), std::max(v0, v1)};
    return axis == Axis::x ? Rect{{u.lo, v.lo}, {u.hi, v.hi}} : Rect{{v.lo, u.lo}, {v.hi, u.hi}};
}

void RunRows::append_lines(const RunRows& rows, std::size_t first, std::size_t count) {
    const std::span<const std::uint32_t> starts = std::span(rows.starts_).subspan(first, count + 1);
    const std::uint32_t begin = starts.front();
    const auto before = static_cast<std::uint32_t>(runs_.size());
    runs_.insert(runs_.end(), rows.runs_.begin() + begin, rows.runs_.begin() + starts.back());
    const std::size_t lines = starts_.size();
    starts_.resize(lines + count);
    for (std::size_t i = 0; i < count; ++i) starts_[lines + i] = before + (starts[i + 1] - begin);
}

std::int64_t RunRows::total_length() const {
    std::int64_t sum = 0;
    for (const Run& run : runs_) sum += run.end - run.begin;
    return sum;
}

void RunRows::serialize(Archive& parcel) {
    parcel(starts_, runs_);
    if (!parcel.unpacks()) return;
    check_row_starts(starts_, runs_.size());
    for (std::size_t l = 0; l < lines(); ++l) {
        const auto overlaps = [](const Run& a, const Run& b) { return a.end >= b.begin; };
        const auto is_empty = [](const Run& run) { return run.begin >= run.end; };
        const std::span<const Run> runs = line(l);
        if (std::ranges::adjacent_find(runs, overlaps) != runs.end() || std::ranges::any_of(runs, is_empty))
            throw FaultError("a layer's parcel has runs that are out of order");
    }
}

}  // namespace lamella
