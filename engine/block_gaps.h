// BlockGaps: what runs, grown by balls, leave of the gaps between what is covered on all lines of a small
// block.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "engine/gap_limits.h"
#include "engine/run_union.h"

namespace lamella {

/// Grows lines of small blocks by all that reaches into their gaps (thesis 3.2).
///
/// A run that begins left of a gap covers on each line all of the gap up to where it reaches, and one that
/// ends right of it all from there on: of such runs one number a line is kept, by SIMD over the lines. What
/// lies within a gap mostly grows until it touches a side, and moves that; the rest is united run by run.
class BlockGaps {
  public:
    /// Lines are clipped to `extent`. `reaches` are those of most runs, and outlive this.
    BlockGaps(const LayerLattice& lattice, const BallReaches& reaches, Run extent);

    /// Begins a block of at most GapLimits::edge layers of as many lines, of which all lines have these runs.
    void begin(const LineBlock& block, std::span<const Run> covered);
    /// Adds a run that may reach into gaps, and how far it reaches in the block.
    void add(const BallRun& run, std::int32_t layer, std::int32_t line, const Reaches& reaches);
    /// Grows all that was added.
    void grow();
    /// Appends the runs of a grown line, counted from the block's first: sorted, disjoint and not touching.
    void append_line(std::int32_t layer, std::int32_t line, std::vector<Run>& out);

  private:
    /// Runs that reach into a gap from one side.
    struct Beside {
        std::vector<GapSource> sources;
        std::size_t farthest;  // the place of what reaches farthest, about
        std::int32_t reached;  // twice its end, about
        void clear();
        /// The farthest first.
        std::span<const GapSource> sorted();
    };
    /// Between two covered runs, or beside them.
    struct Gap {
        Run run;
        Beside left, right;
        std::vector<GapSource> within;
        GapLimits limits;
    };

    LayerLattice lattice_;
    const BallReaches& ball_;
    Run extent_;
    LineBlock block_{};
    std::vector<Run> covered_;
    std::vector<Gap> gaps_;  // one more than covered_; and some for later
    std::size_t gap_count_ = 0;
    std::array<std::vector<Run>, GapLimits::lines> islands_;  // of each line
    CoverTable table_;
    RunUnion union_;
};

}  // namespace lamella
