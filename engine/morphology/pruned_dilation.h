// PrunedDilation: dilates blocks of neighbouring lines by branch and bound; the core of exact offsets.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/morphology/simd_run_union.h"

namespace lamella {

/// Dilation of a block of lines from all lines around it. The block is halved recursively, and runs that
/// cannot matter are dropped on the way (branch and bound).
///
/// Let a run with weight w lie between d and D away from every line of a block. On each of these lines its
/// dilation covers at least all points within sqrt(w - D^2) of the run along the line, and at most those
/// within sqrt(w - d^2). The gaps that the lower bounds of all runs leave contain the gaps of every line. Two
/// kinds of runs are dropped before a block is halved: those that do not reach into a gap even by their upper
/// bound, and those that everywhere in the block reach less far into a gap than another run does. The latter
/// is easy to test, because which of two points is nearer changes at a plane (power diagrams; Chen, Panozzo
/// and Dumas 2018). Runs that are not visible from the block at all are dropped first (PowerCellBounds).
/// Small blocks are not halved: there the remaining runs are united on all lines (SimdRunUnion).
class PrunedDilation {
  public:
    /// Blocks have at most `max_layers` layers. Dilated runs are clipped to `extent`. `reaches` should be the
    /// table of the most frequent radius and must outlive this object. `max_weight` is an upper bound of all
    /// weights.
    PrunedDilation(const LayerLattice& lattice, const BallExtentTable& reaches, Run extent,
                   std::int32_t max_layers, double max_weight);

    /// Dilates the lines of one block of a stack of layers.
    void grow(const LineBlock& block, std::span<const WeightedRows* const> layers);
    /// Returns a dilated line; layer and line are counted from the block's first. Valid until the next
    /// grow().
    std::span<const Run> line(std::int32_t layer, std::int32_t line) const {
        const LineRuns& at = line_runs_[line_index(layer, line)];
        return {runs_.data() + at.from, at.count};
    }

  private:
    /// The runs that may reach into the gaps of a block.
    struct Level {
        std::vector<SourceLine> lines;
        std::vector<WeightedRun> runs;  // runs of `lines`
        std::vector<Run> covered;       // known to be covered on every line of the block
    };
    struct Source {
        const SourceLine* line;
        const WeightedRun* run;
    };
    /// A run that may reach into a gap.
    struct Visible {
        Source source;
        Run most;          // upper bound of what it covers on any line of the block
        const Run* meets;  // the covered run that it sticks out of; null if it begins or ends in a gap itself
    };
    /// For a covered run, the runs that stick out of it farthest to the left and to the right, approximately.
    struct Champions {
        Source left, right;
        std::int32_t least, greatest;  // twice their dilated ends, approximately
    };
    struct LineRuns {
        std::size_t from, count;  // in runs_
    };

    std::size_t line_index(std::int32_t layer, std::int32_t line) const {
        return static_cast<std::size_t>(layer) * static_cast<std::size_t>(block_.lines) +
               static_cast<std::size_t>(line);
    }
    void cover_by_some(std::span<const WeightedRows* const> layers);
    void gather(std::span<const WeightedRows* const> layers);
    void gather_layer(std::int32_t layer, const WeightedRows& rows);
    void list_farthest();
    void refine(const LineBlock& block, std::size_t depth);
    void cover(const LineBlock& block, const Level& above, std::vector<Run>& covered);
    void add_visible(const Level& above, std::span<const Run> covered);
    void add_visible(Source source, const ExtentBounds& reaches, std::span<const Run> covered);
    bool is_outdone(const LineBlock& block, std::size_t k, std::span<const Run> covered) const;
    bool outdoes(const LineBlock& block, Source other, const Visible& seen, bool left, bool right) const;
    void keep_visible(const LineBlock& block, std::size_t depth);
    void finish_lines(const LineBlock& block, const Level& level);
    void place(const LineBlock& block, std::span<const Run> runs);

    LayerLattice lattice_;
    double layer_square_, row_square_;  // squared pitches
    double max_weight_;
    const BallExtentTable& ball_;
    LineBlock block_{};
    std::vector<Level> levels_;  // by depth: how often the block was halved
    RunUnion union_;
    CoverTable table_;
    SimdRunUnion small_;  // for blocks that are not halved
    std::vector<Run> covered_;
    std::vector<ExtentBounds> reaches_;
    std::vector<std::vector<std::int32_t>> farthest_;  // greatest extent, by distance in layers and by line
    std::vector<BlockOffset> aside_;                   // the block's offset from the lines around it
    std::int32_t farthest_lines_ = 0;                  // lines of the block that these lists are for
    std::vector<std::uint32_t> uncovered_;
    std::vector<Visible> visible_;
    std::vector<Champions> champions_;
    std::vector<Run> runs_;
    std::vector<LineRuns> line_runs_;
};

}  // namespace lamella
