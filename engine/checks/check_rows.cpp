// CheckRows: samples rows, or converts cached lines of other back-ends to the rows' run coordinates.
#include "engine/checks/check_rows.h"

#include <algorithm>
#include <cmath>

#include "engine/layers/survey_rows.h"
#include "engine/runs/row_sets.h"

namespace lamella {
namespace {

/// Maps run coordinates of one band to those of another along the same axis. Fixed-point, so that the result
/// is the same on every machine.
class RunMap {
  public:
    RunMap(const RowBand& from, const RowBand& to) {
        const double scale = from.along_pitch / to.along_pitch, shift = to.coordinate(from.along(0));
        scale_ = std::llround(scale * one);
        shift_ = std::llround((shift + 0.5) * one);
    }
    bool turns_round() const { return scale_ < 0; }
    std::int32_t operator()(std::int32_t u) const {
        return static_cast<std::int32_t>((u * scale_ + shift_) >> fraction_bits);
    }

  private:
    static constexpr int fraction_bits = 32;
    static constexpr double one = 4294967296.0;
    std::int64_t scale_, shift_;
};

/// Returns the lines that may meet a rectangle (mm).
RowBand lines_over(const RowBand& lines, const Rect& rect) {
    const int across = lines.axis == Axis::x ? 1 : 0;
    const double a = (rect.lo[across] - lines.across_origin) / lines.across_pitch,
                 b = (rect.hi[across] - lines.across_origin) / lines.across_pitch;
    const double begin = lines.first, end = lines.first + lines.count;
    RowBand over = lines;
    over.first = static_cast<int>(std::clamp(std::floor(std::min(a, b)), begin, end));
    over.count = static_cast<int>(std::clamp(std::ceil(std::max(a, b)), begin, end)) - over.first;
    return over;
}

}  // namespace

CheckRows::CheckRows(const Job& job, double pitch) {
    const dvec3 size = job.bounds.size();
    band_.along_origin = job.bounds.lo.x - pitch;
    band_.across_origin = job.bounds.lo.y - pitch;
    band_.along_pitch = band_.across_pitch = pitch;
    band_.count = static_cast<int>(size.y / pitch) + 4;
    band_.hi = static_cast<int>(size.x / pitch) + 4;
}

CheckRows::CheckRows(const Job& job, const RowBand& lines) : lines_(lines_over(lines, job.bounds.rect())) {
    const int along = lines.axis == Axis::x ? 0 : 1;
    const double pitch = std::abs(lines.line_pitch());
    const int count = lines_->lines();
    band_.axis = lines.axis;
    band_.along_origin = job.bounds.lo[along] - pitch;
    band_.along_pitch = band_.across_pitch = pitch;
    band_.count = count + 2;
    band_.hi = static_cast<int>(job.bounds.size()[along] / pitch) + 4;
    const double lowest =
        count > 0 ? std::min(lines_->line(0), lines_->line(count - 1)) : job.bounds.lo[1 - along];
    band_.across_origin = lowest - 1.5 * pitch;
}

RunRows CheckRows::rows(const SliceField& slice, const Layer& layer, Scratch& scratch) const {
    if (!lines_) return all_rows(slice, band_, scratch);
    const RunRows* kept = layer.kept_lines(slice, *lines_);
    return moved(kept != nullptr ? *kept : all_rows(slice, *lines_, scratch));
}

RunRows CheckRows::support_rows(const Layer& layer, Scratch& scratch) const {
    if (layer.supports() == nullptr) return empty_rows(static_cast<std::size_t>(band_.lines()));
    return rows(*layer.supports(), layer, scratch);
}

/// Converts runs on the shared lines to the check's rows.
RunRows CheckRows::moved(const RunRows& found) const {
    const RunMap map(*lines_, band_);
    RunRows rows;
    rows.reserve(found.lines() + 2, found.runs().size());
    rows.end_line();
    for (std::size_t i = 0; i < found.lines(); ++i) {
        const std::span<const Run> runs = found.line(lines_->across_pitch > 0 ? i : found.lines() - 1 - i);
        if (map.turns_round()) {
            for (auto run = runs.rbegin(); run != runs.rend(); ++run)
                rows.push(map(run->end), map(run->begin));
        } else {
            for (const Run& run : runs) rows.push(map(run.begin), map(run.end));
        }
        rows.end_line();
    }
    rows.end_line();
    return rows;
}

}  // namespace lamella
