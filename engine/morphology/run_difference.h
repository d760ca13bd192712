// RunDifference: the runs of a line from which intervals are subtracted one after the other.
#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "engine/morphology/weighted_rows.h"

namespace lamella {

/// Returns the first of sorted runs that ends after `u`. A line has few runs and the answer is hard to
/// predict, so this is a binary search without branches.
inline const Run* first_ending_behind(std::span<const Run> runs, std::int32_t u) {
    const Run* first = runs.data();
    for (std::size_t left = runs.size(); left > 0;) {
        const std::size_t half = (left + 1) / 2;
        first += half & (std::size_t{0} - static_cast<std::size_t>(first[half - 1].end <= u));
        left -= half;
    }
    return first;
}

/// The runs of a line from which intervals are subtracted step by step. Buffers are kept from line to line.
class RunDifference {
  public:
    void assign(std::span<const Run> runs) {
        count_ = runs.size();
        make_room(count_);
        std::ranges::copy(runs, runs_.begin());
    }
    bool empty() const { return count_ == 0; }
    std::span<const Run> all() const { return {runs_.data(), count_}; }

    /// Subtracts sorted runs, each extended by `reach` to both sides. There must be runs left. Which of two
    /// runs ends first is hard to predict, so no branch depends on it: each step writes a piece that may
    /// remain, and counts it if it is not empty.
    void subtract(std::span<const Run> taken, const RoundedExtent& reach) {
        const Run *t = taken.data(), *const end = t + taken.size();
        const std::int32_t first = runs_.front().begin - reach.ahead,
                           last = runs_[count_ - 1].end + reach.back;
        while (t != end && t->end <= first) ++t;
        if (t == end || t->begin >= last) return;
        make_room(count_ + static_cast<std::size_t>(end - t) + 1);
        const Run *run = runs_.data(), *const runs_end = run + count_;
        Run* left = buffer_.data();
        std::int32_t from = std::numeric_limits<std::int32_t>::min();  // end of the last subtracted interval
        while (t != end && run != runs_end) {
            const std::int32_t to = t->begin - reach.back, behind = t->end + reach.ahead;
            *left = {std::max(run->begin, from), std::min(run->end, to)};
            left += left->begin < left->end ? 1 : 0;
            const bool goes_on = to < run->end;
            from = goes_on ? behind : from;
            t += goes_on ? 1 : 0;
            run += goes_on ? 0 : 1;
        }
        for (; run != runs_end; ++run) {
            *left = {std::max(run->begin, from), run->end};
            left += left->begin < left->end ? 1 : 0;
        }
        count_ = static_cast<std::size_t>(left - buffer_.data());
        runs_.swap(buffer_);
    }

  private:
    void make_room(std::size_t count) {
        if (buffer_.size() < count) buffer_.resize(2 * count);
        if (runs_.size() < count) runs_.resize(2 * count);
    }
    std::vector<Run> runs_, buffer_;  // the first count_ of runs_ are valid
    std::size_t count_ = 0;
};

}  // namespace lamella
