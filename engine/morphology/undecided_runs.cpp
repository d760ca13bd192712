// UndecidedRuns: intervals trimmed at their ends, with a linked list of known ball centres for each run.
#include "engine/morphology/undecided_runs.h"

#include <algorithm>

namespace lamella {
namespace {

constexpr double beyond_the_ball = -2;  // an extent that stays negative when rounded

}  // namespace

void BallCenters::forget_below(std::int32_t layer) {
    const auto past =
        std::ranges::find_if(kept_, [&](const BallCenter& center) { return center.layer >= layer; });
    // Erasing moves the rest, so wait until at least as many go as stay.
    if (past - kept_.begin() < kept_.end() - past) return;
    first_ += static_cast<std::uint32_t>(past - kept_.begin());
    kept_.erase(kept_.begin(), past);
}

BallFootprint::BallFootprint(const BallLines& ball) : layers_(ball.layers()), rows_(ball.rows()) {
    reaches_.assign(number(2 * layers_, 2 * rows_) + 1, RoundedExtent(beyond_the_ball));
    for (const BallLines::Line& line : ball.lines())
        reaches_[number(line.layer + layers_, line.row + rows_)] = line.reach;
}

UndecidedRuns::UndecidedRuns(const RunRows& rows, std::int32_t layer, std::size_t first_line,
                             std::size_t count)
    : layer_(layer),
      open_(rows.runs().size(), Run{0, 0}),
      near_(rows.runs().size()),
      known_in_(rows.lines(), 0) {
    for (std::size_t l = first_line; l < first_line + count; ++l) {
        std::size_t number = first_run(rows, l);
        for (const Run& run : rows.line(l)) open_[number++] = run;
    }
}

void UndecidedRuns::decide_within(std::uint32_t center, const BallCenters& centers, const NumberedRun& run,
                                  const BallFootprint& near) {
    const Run closed = near.on_line(centers[center], layer_, static_cast<std::int32_t>(run.line));
    Run& open = open_[run.number];
    if (closed.end <= open.begin || open.end <= closed.begin) return;
    if (closed.begin <= open.begin) {
        open.begin = closed.end;
    } else if (closed.end >= open.end) {
        open.end = closed.begin;
    } else {
        return;
    }
    ++known_in_[run.line];
    Link& first = near_[run.number];
    if (first.center == none) {
        first.center = center;
        return;
    }
    more_.push_back({center, first.next});
    first.next = static_cast<std::uint32_t>(more_.size()) - 1;
}

/// Applies all ball centres known to run number `other` of `others` to `run`.
void UndecidedRuns::close_near_all(const UndecidedRuns& others, std::size_t other, const BallCenters& centers,
                                   const NumberedRun& run, const BallFootprint& near) {
    Link link = others.near_[other];
    while (link.center != none && is_open(run.number)) {
        decide_within(link.center, centers, run, near);
        link = link.next == none ? Link{} : others.more_[link.next];
    }
}

void UndecidedRuns::inherit_from(const UndecidedRuns& others, const RunRows& other_rows,
                                 std::size_t other_line, const BallCenters& centers, const Run& whole,
                                 const NumberedRun& run, const BallFootprint& near) {
    const std::span<const Run> beside = other_rows.line(other_line);
    const Run *other = first_ending_behind(beside, whole.begin), *const end = beside.data() + beside.size();
    for (; other != end && other->begin < whole.end && is_open(run.number); ++other)
        close_near_all(others, static_cast<std::size_t>(other - other_rows.runs().data()), centers, run,
                       near);
}

void UndecidedRuns::inherit_from(const UndecidedRuns& others, const RunRows& other_rows,
                                 const BallCenters& centers, const RunRows& rows, const BallFootprint& near) {
    for (std::size_t l = rows.line_with_runs(0); l < rows.lines(); l = rows.line_with_runs(l + 1)) {
        if (!others.knows_any(l)) continue;
        const std::span<const Run> beside = other_rows.line(l);
        std::size_t number = first_run(rows, l), next = first_run(other_rows, l);
        const std::size_t end = next + beside.size();
        const Run* const all = other_rows.runs().data();
        for (const Run& run : rows.line(l)) {
            while (next != end && all[next].end <= run.begin) ++next;
            for (std::size_t other = next; other != end && all[other].begin < run.end && is_open(number);
                 ++other)
                close_near_all(others, other, centers, {l, number}, near);
            ++number;
        }
    }
}

}  // namespace lamella
