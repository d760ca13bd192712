// RunCollector: collects the runs of many overlapping convex objects and merges them line by line.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/runs/runs.h"

namespace lamella {

/// Each convex object gives at most one run on each of some consecutive lines. Kernels write the runs of one
/// object straight into the collector; a pair with begin >= end is a miss.
class RunCollector {
  public:
    /// Output of a kernel: begin[i] and end[i] belong to line first + i. Kernels may overwrite up to `slack`
    /// entries beyond the last one requested.
    struct Segment {
        std::int32_t* begin;
        std::int32_t* end;
    };
    static constexpr std::size_t slack = 64;

    void clear();
    /// Allocates `count` runs on lines [first, first + count); the pointers are valid until the next call.
    Segment add(int first, int count);
    /// Merges all runs into sorted, disjoint runs clipped to the band; `out` gets one line per line of the
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
    std::vector<std::uint32_t> starts_,
        next_;  // per line: index in runs_ of its first run, and of its next one
    std::vector<Run> runs_;
};

}  // namespace lamella
