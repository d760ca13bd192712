// RunUnion: the union of many overlapping runs of one line, without sorting them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/runs/runs.h"

namespace lamella {

/// The runs that begin in one cell (a pixel) of the line and leave it overlap: their union is one run, from
/// the least begin to the greatest end. Runs within one cell are few and stored separately.
class RunUnion {
  public:
    /// Runs added are clipped to `extent`.
    explicit RunUnion(Run extent);

    void add(std::int32_t begin, std::int32_t end) { cells().add(begin, end); }

    /// View of the cells for inner loops, where a compiler cannot know that adding runs leaves the pointers
    /// alone.
    class Cells {
      public:
        void add(std::int32_t begin, std::int32_t end) const {
            begin = std::max(begin, extent_.begin);
            end = std::min(end, extent_.end);
            if (begin >= end) return;
            const std::size_t cell = cell_of(begin);
            if (cell_of(end) == cell) {
                small_->push_back({begin, end});
                return;
            }
            used_[cell / 64] |= std::uint64_t{1} << (cell % 64);
            Run& run = cells_[cell];
            run.begin = std::min(run.begin, begin);
            run.end = std::max(run.end, end);
        }

      private:
        friend class RunUnion;
        Cells(Run extent, Run* cells, std::uint64_t* used, std::vector<Run>* small)
            : extent_(extent), cells_(cells), used_(used), small_(small) {}
        std::size_t cell_of(std::int32_t at) const {
            return static_cast<std::uint32_t>(at - extent_.begin) / run_unit;
        }
        Run extent_;
        Run* cells_;
        std::uint64_t* used_;
        std::vector<Run>* small_;
    };
    Cells cells() { return {extent_, cells_.data(), used_.data(), &small_}; }

    /// Appends the runs of the union, sorted, disjoint and not touching, and empties this object.
    void take(std::vector<Run>& out);

  private:
    Run extent_;
    std::vector<Run> cells_, small_;
    std::vector<std::uint64_t> used_;  // a bit for each cell
};

/// Lookup of the runs of a union by position.
class CoverTable {
  public:
    explicit CoverTable(Run extent);
    /// Indexes the `runs` of a union.
    void assign(std::span<const Run> runs);
    /// Returns true only if the run, which lies in the extent, is covered. Conservative: may return false
    /// when the covering run begins in the same cell as `run`.
    bool surely_covers(const Run& run) const {
        return until_[static_cast<std::uint32_t>(run.begin - extent_.begin) / run_unit] >= run.end;
    }
    Run clip(Run run) const { return {std::max(run.begin, extent_.begin), std::min(run.end, extent_.end)}; }
    /// Returns the index of the first run that ends right of `at`, which lies in the extent; else the number
    /// of runs.
    std::size_t first_run(std::int32_t at) const {
        std::size_t run = cells_[static_cast<std::uint32_t>(at - extent_.begin) / run_unit];
        while (run < ends_.size() && ends_[run] <= at) ++run;
        return run;
    }

  private:
    Run extent_;
    std::vector<std::uint32_t> cells_;  // index of the first run that ends in the cell or behind it
    std::vector<std::int32_t> until_;   // end of the run that covers the cell's begin, or the least number
    std::vector<std::int32_t> ends_;
};

}  // namespace lamella
