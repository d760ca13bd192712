// BallCentersByRun: the ball centres found in each run of a layer, and the runs that were searched for them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/runs/runs.h"

namespace lamella {

/// Stretches of a layer's runs, found in one of them after another.
class BallCentersByRun {
  public:
    explicit BallCentersByRun(const RunRows& rows)
        : is_searched_(rows.runs().size(), 0), in_lines_(rows.lines()), to_search_(rows.lines()) {
        for (std::size_t l = 0; l < rows.lines(); ++l)
            to_search_[l] = static_cast<std::uint32_t>(rows.line(l).size());
    }

    /// Whether all runs of a line were searched.
    bool all_searched(std::size_t line) const { return to_search_[line] == 0; }
    bool is_searched(std::size_t run) const { return is_searched_[run] != 0; }
    /// What was found, sorted, in a run of that line that was not searched before.
    void put(std::size_t run, std::size_t line, std::span<const Run> found) {
        is_searched_[run] = 1;
        --to_search_[line];
        if (found.empty()) return;
        std::vector<Run>& all = in_lines_[line];
        all.insert(std::ranges::lower_bound(all, found.front().begin, {}, &Run::begin), found.begin(),
                   found.end());
    }
    /// All that was found in the runs of a line, sorted.
    std::span<const Run> in_line(std::size_t line) const { return in_lines_[line]; }

  private:
    std::vector<std::uint8_t> is_searched_;  // of each run
    std::vector<std::vector<Run>> in_lines_;
    std::vector<std::uint32_t> to_search_;  // how many, of each line
};

}  // namespace lamella
