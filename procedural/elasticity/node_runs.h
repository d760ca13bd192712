// NodeRuns: the parts of a grid where there is something, and loops and sums over them.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "engine/base/parallel.h"

namespace lamella {

/// Runs of consecutive node numbers, in ascending order. Loops run in parallel over groups of runs; groups
/// depend on the grid alone, so that sums round alike on any number of threads.
class NodeRuns {
  public:
    struct Run {
        std::size_t begin, end;
    };

    NodeRuns() = default;
    /// Makes runs of whole tiles from one flag a tile.
    NodeRuns(const std::vector<std::uint8_t>& used_tiles, std::size_t tile) {
        std::size_t in_group = group_size;
        for (std::size_t t = 0; t < used_tiles.size(); ++t) {
            if (used_tiles[t] == 0) continue;
            if (in_group >= group_size) {
                groups_.push_back(runs_.size());
                in_group = 0;
            }
            const bool goes_on = groups_.back() < runs_.size() && runs_.back().end == t * tile;
            if (goes_on) {
                runs_.back().end += tile;
            } else {
                runs_.push_back({t * tile, (t + 1) * tile});
            }
            in_group += tile;
        }
        groups_.push_back(runs_.size());
    }

    /// Calls work(begin, end) for each run, in parallel.
    template <typename Work>
    void for_each(const Work& work) const {
        if (groups_.empty()) return;
        parallel_for(groups_.size() - 1, [&](std::size_t g) {
            for (std::size_t r = groups_[g]; r < groups_[g + 1]; ++r) work(runs_[r].begin, runs_[r].end);
        });
    }
    /// Returns the sum of what work(begin, end) returns for each run.
    template <typename Work>
    double sum(const Work& work) const {
        if (groups_.empty()) return 0;
        std::vector<double> parts(groups_.size() - 1, 0.0);
        parallel_for(parts.size(), [&](std::size_t g) {
            for (std::size_t r = groups_[g]; r < groups_[g + 1]; ++r)
                parts[g] += work(runs_[r].begin, runs_[r].end);
        });
        double total = 0;
        for (const double part : parts) total += part;
        return total;
    }

  private:
    static constexpr std::size_t group_size = 2048;

    std::vector<Run> runs_;
    std::vector<std::size_t> groups_;  // first run of each group, and the number of runs
};

}  // namespace lamella
