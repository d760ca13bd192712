// BallCentersByRun: the ball centres found in each run of a layer, and the runs that were searched for them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/runs/runs.h"

namespace lamella {

/// The ball centres of one layer. Runs are searched one at a time, in any order; each search stores its
/// result here.
class BallCentersByRun {
  public:
    explicit BallCentersByRun(const RunRows& rows)
        : is_searched_(rows.runs().size(), 0), in_lines_(rows.lines()), to_search_(rows.lines()) {
        for (std::size_t l = 0; l < rows.lines(); ++l)
            to_search_[l] = static_cast<std::uint32_t>(rows.line(l).size());
    }

    /// Returns true if all runs of a line were searched.
    bool all_searched(std::size_t line) const { return to_search_[line] == 0; }
    bool is_searched(std::size_t run) const { return is_searched_[run] != 0; }
    /// Stores the sorted centres found in run number `run`, which lies on `line` and was not searched before.
    void put(std::size_t run, std::size_t line, std::span<const Run> found) {
        is_searched_[run] = 1;
        --to_search_[line];
        if (found.empty()) return;
        std::vector<Run>& all = in_lines_[line];
        all.insert(std::ranges::lower_bound(all, found.front().begin, {}, &Run::begin), found.begin(),
                   found.end());
    }
    /// Returns all centres found so far on a line, sorted.
    std::span<const Run> in_line(std::size_t line) const { return in_lines_[line]; }

  private:
    std::vector<std::uint8_t> is_searched_;   // by run
    std::vector<std::vector<Run>> in_lines_;  // centres by line
    std::vector<std::uint32_t> to_search_;    // number of runs not yet searched, by line
};

}  // namespace lamella
