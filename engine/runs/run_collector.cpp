// Scatters the runs to their lines, sorts each line, then joins overlaps in one pass.
#include "engine/runs/run_collector.h"

#include <algorithm>
#include <limits>

namespace lamella {
namespace {

/// Sorts runs by their begin. Insertion sort, because they mostly come nearly sorted; when it has to move too
/// much (several sorted sequences in a row), std::sort takes over.
void sort_by_begin(Run* first, Run* last) {
    std::ptrdiff_t moves_left = 8 * (last - first);
    for (Run* r = first; r != last; ++r) {
        const Run run = *r;
        Run* place = r;
        for (; place != first && run.begin < place[-1].begin; --place) *place = place[-1];
        *place = run;
        moves_left -= r - place;
        if (moves_left < 0) {
            std::sort(first, last, [](const Run& a, const Run& b) { return a.begin < b.begin; });
            return;
        }
    }
}

/// Joins sorted runs that overlap or touch, in place, and clips them to [lo, hi). Overlaps are hard to
/// predict, so no branch depends on them: the current run is written at every step, and kept only when the
/// next one begins behind it.
std::span<const Run> join_and_clip(std::span<Run> runs, std::int32_t lo, std::int32_t hi) {
    if (runs.empty()) return {};
    const auto clipped = [&](const Run& run) {
        return Run{std::clamp(run.begin, lo, hi), std::clamp(run.end, lo, hi)};
    };
    Run* next = runs.data();
    Run joined = clipped(runs.front());
    for (const Run& run : runs.subspan(1)) {
        const auto [begin, end] = clipped(run);
        const bool apart = begin > joined.end;
        *next = joined;
        next += apart;
        joined = {apart ? begin : joined.begin, std::max(joined.end, end)};
    }
    *next++ = joined;
    // Runs outside [lo, hi) have become one empty run at either end.
    const Run *first = runs.data(), *last = next;
    if (first->begin == first->end) ++first;
    if (first < last && last[-1].begin == last[-1].end) --last;
    return {first, last};
}

/// Sentinel before the runs of each line: no run joins it.
constexpr Run joins_nothing{std::numeric_limits<std::int32_t>::max(),
                            std::numeric_limits<std::int32_t>::min()};

}  // namespace

void RunCollector::clear() {
    pieces_.clear();
    used_ = 0;
}

RunCollector::Segment RunCollector::add(int first, int count) {
    const std::size_t from = used_;
    used_ += static_cast<std::size_t>(count);
    if (begins_.size() < used_ + slack) {
        begins_.resize(2 * used_ + slack);
        ends_.resize(2 * used_ + slack);
    }
    pieces_.push_back({first, count});
    return {begins_.data() + from, ends_.data() + from};
}

void RunCollector::merge(const RowBand& band, RunRows& out) {
    const auto lines = static_cast<std::size_t>(band.lines());
    make_room(lines);
    // Scatter the runs to their lines. Objects in sequence are mostly neighbours whose runs overlap; these
    // are joined right here. Whether they overlap is hard to predict, so no branch depends on it. Misses are
    // written too, and overwritten by the next run.
    std::size_t k = 0;
    for (const Piece& piece : pieces_) {
        std::uint32_t* const next = next_.data() + piece.first;
        for (int i = 0; i < piece.count; ++i, ++k) {
            const Run run{begins_[k], ends_[k]}, last = runs_[next[i] - 1];
            const bool hit = run.begin < run.end;
            const bool joins = hit && run.begin <= last.end && last.begin <= run.end;
            runs_[next[i] - (joins ? 1 : 0)] = {joins ? std::min(run.begin, last.begin) : run.begin,
                                                joins ? std::max(run.end, last.end) : run.end};
            next[i] += hit && !joins ? 1 : 0;
        }
    }
    const std::int32_t lo = band.lo * run_unit, hi = band.hi * run_unit;
    out.clear();
    for (std::size_t l = 0; l < lines; ++l) {
        Run* const first = runs_.data() + starts_[l];
        Run* const last = runs_.data() + next_[l];
        sort_by_begin(first, last);
        out.append_line(join_and_clip({first, last}, lo, hi));
    }
}

/// Allocates runs_: each line gets a sentinel and then as many runs as pieces cover it, with one spare run at
/// the very end.
void RunCollector::make_room(std::size_t lines) {
    // The number of pieces that begin minus those that end at each line, then its prefix sum, then the sum of
    // that.
    starts_.assign(lines + 1, 0);
    for (const Piece& piece : pieces_) {
        const auto first = static_cast<std::size_t>(piece.first),
                   count = static_cast<std::size_t>(piece.count);
        ++starts_[first];
        --starts_[first + count];
    }
    std::uint32_t open = 0, start = 1;
    for (std::uint32_t& line : starts_) {
        open += line;
        line = start;
        start += open + 1;
    }
    runs_.resize(start);
    for (const std::uint32_t line : starts_) runs_[line - 1] = joins_nothing;
    next_.assign(starts_.begin(), starts_.end());
}

}  // namespace lamella
