// SupportHold: subtracts the reach of supports and of their upper ends, nearest rows first, until nothing is
// left.
#include "engine/checks/support_hold.h"

#include <algorithm>
#include <cmath>

#include "engine/runs/row_sets.h"

namespace lamella {
namespace {

double square(std::size_t rows) {
    const double distance = static_cast<double>(rows) * run_unit;
    return distance * distance;
}

/// Subtracts a run from sorted runs.
void take_away(const Run& taken, std::vector<Run>& from) {
    auto run = std::ranges::partition_point(from, [&](const Run& r) { return r.end <= taken.begin; });
    if (run == from.end() || run->begin >= taken.end) return;
    if (run->begin < taken.begin) {
        const std::int32_t end = run->end;
        run->end = taken.begin;
        ++run;
        if (taken.end < end) {
            from.insert(run, {taken.end, end});
            return;
        }
    }
    const auto last = std::find_if(run, from.end(), [&](const Run& r) { return r.end > taken.end; });
    if (last != from.end()) last->begin = std::max(last->begin, taken.end);
    from.erase(run, last);
}

}  // namespace

SupportHold::SupportHold(const CheckGrid& grid, double spacing, double gap)
    : spacing_(spacing),
      gap_(gap),
      plan_(grid.layers),
      unit_(grid.band.along_pitch / run_unit),
      layers_up_(static_cast<std::size_t>((spacing + gap) / grid.layers.least_height())),
      last_(empty_rows(static_cast<std::size_t>(grid.band.count))),
      tops_(last_.lines()) {
    const double most = weight(0, 0);
    for (std::size_t r = 0; r < last_.lines() && square(r) <= most; ++r)
        reaches_.emplace_back(std::sqrt(most - square(r)));
}

bool SupportHold::empty() const {
    return last_.runs().empty() && std::ranges::all_of(tops_, &std::vector<Top>::empty);
}

double SupportHold::weight(std::size_t top, std::size_t layer) const {
    const double apart = plan_.height(static_cast<int>(top), static_cast<int>(layer));
    const double way = std::max(apart - gap_, 0.0);
    return (spacing_ * spacing_ - way * way) / (unit_ * unit_);
}

template <typename Take>
void SupportHold::for_held_by_row(std::size_t row, std::size_t rows_away, const Run& about, Take take) const {
    const RoundedExtent most = reaches_[rows_away];
    const std::int32_t first = about.begin - most.ahead, last = about.end + most.back;
    const auto reaches = [&](const Run& run) { return run.end > first && run.begin < last; };
    for (const Run& run : last_.line(row)) {
        if (reaches(run)) take({run.begin - most.back, run.end + most.ahead});
    }
    for (const Top& top : tops_[row]) {
        if (!reaches(top.run)) continue;
        const double left = weight(top.layer, layers_) - square(rows_away);
        if (left < 0) continue;
        const RoundedExtent reach(std::sqrt(left));
        take({top.run.begin - reach.back, top.run.end + reach.ahead});
    }
}

RunRows SupportHold::unheld(const RunRows& rows) const {
    if (rows.runs().empty() || empty()) return rows;
    RunRows out;
    std::vector<Run> left;
    const auto take = [&](const Run& held) { take_away(held, left); };
    for (std::size_t l = rows.line_with_runs(0); l < rows.lines(); l = rows.line_with_runs(l + 1)) {
        left.assign(rows.line(l).begin(), rows.line(l).end());
        for (std::size_t away = 0; away < reaches_.size() && !left.empty(); ++away) {
            const Run about{left.front().begin, left.back().end};
            if (away <= l) for_held_by_row(l - away, away, about, take);
            if (away > 0 && l + away < rows.lines()) for_held_by_row(l + away, away, about, take);
        }
        out.end_lines(l - out.lines());
        out.append_line(left);
    }
    out.end_lines(rows.lines() - out.lines());
    return out;
}

void SupportHold::add(const RunRows& supports) {
    const RunRows ended = without(last_, supports);
    for (std::size_t l = 0; l < ended.lines(); ++l) {
        std::vector<Top>& tops = tops_[l];
        for (const Run& run : ended.line(l)) tops.push_back({run, layers_});
        const auto reaches_on = [&](const Top& top) { return layers_ + 1 - top.layer <= layers_up_; };
        tops.erase(tops.begin(), std::ranges::find_if(tops, reaches_on));
    }
    last_ = supports;
    ++layers_;
}

}  // namespace lamella
