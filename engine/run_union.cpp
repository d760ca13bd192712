// Cells from left to right.
#include "engine/run_union.h"

#include <algorithm>
#include <limits>

namespace lamella {
namespace {

constexpr Run nothing{std::numeric_limits<std::int32_t>::max(), std::numeric_limits<std::int32_t>::min()};

}  // namespace

void RunUnion::reset(std::int32_t lo, std::int32_t hi) {
    lo_ = lo;
    hi_ = std::max(lo, hi);
    cells_.assign(static_cast<std::size_t>((hi_ - lo_) / run_unit) + 1, nothing);
    small_.clear();
    least_ = nothing.begin;
    greatest_ = nothing.end;
}

void RunUnion::take(SpanRows& out) {
    std::ranges::sort(small_, {}, &Run::begin);
    auto small = small_.begin();
    // Ends that were taken for the borders' are put back.
    const auto push = [&](const Run& run) {
        out.push(run.begin == lo_ ? least_ : run.begin, run.end == hi_ ? greatest_ : run.end);
    };
    for (Run& cell : cells_) {
        if (cell.end < cell.begin) continue;
        for (; small != small_.end() && small->begin < cell.begin; ++small) push(*small);
        push(cell);
        cell = nothing;
    }
    for (; small != small_.end(); ++small) push(*small);
    out.end_line();
    small_.clear();
    least_ = nothing.begin;
    greatest_ = nothing.end;
}

}  // namespace lamella
