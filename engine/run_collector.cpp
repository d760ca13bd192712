// Counting sort by line, insertion sort within a line, then one merging pass.
#include "engine/run_collector.h"

namespace lamella {

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
    // starts_[l + 1] becomes the place of the next run of line l, and ends as the first of line l + 1.
    for (std::size_t l = 1; l < lines + 2; ++l) starts_[l] += starts_[l - 1];
    runs_.resize(starts_.back());
    k = 0;
    for (const Piece& piece : pieces_) {
        std::uint32_t* next = starts_.data() + piece.first + 1;
        for (int i = 0; i < piece.count; ++i, ++k) {
            if (begins_[k] < ends_[k]) runs_[next[i]++] = {begins_[k], ends_[k]};
        }
    }
    out.clear();
    for (std::size_t l = 0; l < lines; ++l) {
        Run* const first = runs_.data() + starts_[l];
        Run* const last = runs_.data() + starts_[l + 1];
        for (Run* r = first; r != last; ++r) {
            const Run run = *r;
            Run* place = r;
            for (; place != first && run.begin < place[-1].begin; --place) *place = place[-1];
            *place = run;
        }
        for (const Run* r = first; r != last; ++r) out.push(std::max(r->begin, lo), std::min(r->end, hi));
        out.end_line();
    }
}

}  // namespace lamella
