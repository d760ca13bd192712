// The bounds cut a solid away even where it continues.
#include "recipe/output/plane_runs.h"

namespace lamella {
namespace {

/// Removes what lies outside the bounds, even if the solid continues there.
void clip(const RowBand& band, const Rect& bounds, RunRows& rows, RunRows& clipped) {
    const bool is_row = band.axis == Axis::x;
    const std::int32_t low = round_run(band.coordinate(is_row ? bounds.lo.x : bounds.lo.y));
    const std::int32_t high = round_run(band.coordinate(is_row ? bounds.hi.x : bounds.hi.y));
    const double first = is_row ? bounds.lo.y : bounds.lo.x, last = is_row ? bounds.hi.y : bounds.hi.x;
    clipped.clear();
    for (std::size_t line = 0; line < rows.lines(); ++line) {
        const double across = band.line(static_cast<int>(line));
        if (across >= first && across <= last) {
            for (const Run& run : rows.line(line))
                clipped.push(std::max(run.begin, low), std::min(run.end, high));
        }
        clipped.end_line();
    }
}

}  // namespace

void PlaneRuns::cut(const TwoSolids& solids, SliceContext& context, double height, const RowBand& band,
                    const Rect& bounds) {
    context.slice(*solids.part, height).runs(band, scratch_, whole_);
    clip(band, bounds, whole_, part_);
    has_second_ = solids.second != nullptr;
    if (!has_second_) return;
    context.slice(*solids.second, height).runs(band, scratch_, whole_);
    clip(band, bounds, whole_, second_);
    unite(part_, second_, all_);
}

}  // namespace lamella
