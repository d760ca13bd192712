// RunUnion: the union of many overlapping runs of one line, without sorting them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "engine/runs.h"

namespace lamella {

/// Of all runs that begin in one cell of the line, a pixel long, and leave it, the union is one run: from the
/// least begin to the greatest end. Runs within a cell are few, and kept apart.
class RunUnion {
  public:
    /// Runs lie in [lo, hi), run units; what sticks out of that is as one run on either side.
    void reset(std::int32_t lo, std::int32_t hi);

    void add(std::int32_t begin, std::int32_t end) {
        least_ = std::min(least_, begin);
        greatest_ = std::max(greatest_, end);
        begin = std::max(begin, lo_);
        end = std::min(end, hi_);
        if (begin >= end) return;
        const std::int32_t cell = (begin - lo_) / run_unit;
        if ((end - lo_) / run_unit == cell) {
            small_.push_back({begin, end});
            return;
        }
        Run& run = cells_[static_cast<std::size_t>(cell)];
        run.begin = std::min(run.begin, begin);
        run.end = std::max(run.end, end);
    }
    /// Appends the runs of the union to a line of `out`, which is ended, and forgets them.
    void take(SpanRows& out);

  private:
    std::int32_t lo_ = 0, hi_ = 0;
    std::int32_t least_ = 0, greatest_ = 0;  // of all begins and ends
    std::vector<Run> cells_, small_;
};

}  // namespace lamella
