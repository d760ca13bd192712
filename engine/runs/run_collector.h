// Collects the runs of many convex things that overlap, and merges them line by line.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/runs/runs.h"

namespace lamella {

/// Each convex thing gives at most one run on each of some consecutive lines. Kernels write the runs of one
/// thing straight into the collector; a pair with begin >= end is a miss.
class RunCollector {
  public:
    /// Where a kernel writes: begin[i] and end[i] belong to line first + i. Kernels may overwrite up to
    /// `slack` entries beyond the last one asked for.
    struct Segment {
        std::int32_t* begin;
        std::int32_t* end;
    };
    static constexpr std::size_t slack = 64;

    void clear();
    /// Room for `count` runs on lines [first, first + count); valid until the next call.
    Segment add(int first, int count);
    /// Merges everything to sorted, disjoint runs clipped to the band; one line of `out` for each line of the
    /// band.
    void merge(const RowBand& band, RunRows& out);

  private:
    struct Piece {
        int first;
        int count;
    };
    void make_room(std::size_t lines);

    std::vector<Piece> pieces_;
    std::vector<std::int32_t> begins_, ends_;
    std::size_t used_ = 0;
    std::vector<std::uint32_t> starts_, next_;  // of each line in runs_: its first run, and its next one
    std::vector<Run> runs_;
};

}  // namespace lamella
