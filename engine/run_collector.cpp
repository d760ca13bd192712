// Counting sort by line, a sort within each line, then one merging pass.
#include "engine/run_collector.h"

#include <algorithm>

namespace lamella {
namespace {

/// Sorts runs by their begin. They mostly come nearly sorted, which insertion makes the best of; when it has
/// to move too much (several sorted sequences one after the other), the general sort takes over.
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

void RunCollector::merge(const RowBand& band, SpanRows& out) {
    const auto lines = static_cast<std::size_t>(band.lines());
    const std::int32_t lo = band.lo * run_unit, hi = band.hi * run_unit;
    starts_.assign(lines + 2, 0);
    std::size_t k = 0;
    for (const Piece& piece : pieces_) {
        std::uint32_t* count = starts_.data() + piece.first + 2;
        for (int i = 0; i < piece.count; ++i, ++k) count[i] += begins_[k] < ends_[k] ? 1 : 0;
    }
    for (std::size_t l = 1; l < lines + 2; ++l) starts_[l] += starts_[l - 1];
    runs_.resize(starts_.back());
    // Line l has room from starts_[l + 1] on. Neighbours in a line mostly overlap, and join right here.
    ends_of_lines_.assign(starts_.begin() + 1, starts_.end());
    k = 0;
    for (const Piece& piece : pieces_) {
        const std::uint32_t* const start = starts_.data() + piece.first + 1;
        std::uint32_t* const next = ends_of_lines_.data() + piece.first;
        for (int i = 0; i < piece.count; ++i, ++k) {
            const Run run{begins_[k], ends_[k]};
            if (run.begin >= run.end) continue;
            Run* const place = runs_.data() + next[i];
            if (next[i] > start[i] && run.begin <= place[-1].end && place[-1].begin <= run.end) {
                place[-1] = {std::min(place[-1].begin, run.begin), std::max(place[-1].end, run.end)};
            } else {
                *place = run;
                ++next[i];
            }
        }
    }
    out.clear();
    for (std::size_t l = 0; l < lines; ++l) {
        Run* const first = runs_.data() + starts_[l + 1];
        Run* const last = runs_.data() + ends_of_lines_[l];
        sort_by_begin(first, last);
        for (const Run* r = first; r != last; ++r) out.push(std::max(r->begin, lo), std::min(r->end, hi));
        out.end_line();
    }
}

}  // namespace lamella
