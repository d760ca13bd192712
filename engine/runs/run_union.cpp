// Scans the cells from left to right.
#include "engine/runs/run_union.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace lamella {
namespace {

constexpr Run empty_run{std::numeric_limits<std::int32_t>::max(), std::numeric_limits<std::int32_t>::min()};

std::size_t cells_of(Run extent) {
    return static_cast<std::size_t>((extent.end - extent.begin) / run_unit) + 1;
}

}  // namespace

RunUnion::RunUnion(Run extent)
    : extent_(extent), cells_(cells_of(extent), empty_run), used_(cells_.size() / 64 + 1, 0) {}

void RunUnion::take(std::vector<Run>& out) {
    std::ranges::sort(small_, {}, &Run::begin);
    const std::size_t first = out.size();
    const auto push = [&](const Run& run) {
        if (out.size() > first && run.begin <= out.back().end) {
            out.back().end = std::max(out.back().end, run.end);
        } else {
            out.push_back(run);
        }
    };
    auto small = small_.begin();
    for (std::size_t i = 0; i < used_.size(); ++i) {
        for (; used_[i] != 0; used_[i] &= used_[i] - 1) {
            Run& cell = cells_[i * 64 + static_cast<std::size_t>(std::countr_zero(used_[i]))];
            for (; small != small_.end() && small->begin < cell.begin; ++small) push(*small);
            push(cell);
            cell = empty_run;
        }
    }
    for (; small != small_.end(); ++small) push(*small);
    small_.clear();
}

CoverTable::CoverTable(Run extent) : extent_(extent), cells_(cells_of(extent), 0), until_(cells_.size(), 0) {}

void CoverTable::assign(std::span<const Run> runs) {
    ends_.clear();
    std::size_t cell = 0;
    const auto begin_of = [&](std::size_t c) {
        return extent_.begin + static_cast<std::int32_t>(c) * run_unit;
    };
    for (const Run& run : runs) {
        const auto last = static_cast<std::size_t>((run.end - extent_.begin) / run_unit);
        for (; cell <= last; ++cell) {
            cells_[cell] = static_cast<std::uint32_t>(ends_.size());
            until_[cell] = run.begin <= begin_of(cell) ? run.end : empty_run.end;
        }
        ends_.push_back(run.end);
    }
    std::fill(cells_.begin() + static_cast<std::ptrdiff_t>(cell), cells_.end(),
              static_cast<std::uint32_t>(ends_.size()));
    std::fill(until_.begin() + static_cast<std::ptrdiff_t>(cell), until_.end(), empty_run.end);
}

}  // namespace lamella
