// PrunedDilation: dilates neighbouring lines together by branch and bound; the core of exact offsets.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/morphology/simd_run_union.h"

namespace lamella {

/// Grows lines by what all lines about them give them, by halving blocks of them (branch and bound).
///
/// A run that lies, across the lines, between d and D away from all lines of a block covers on each of these
/// what lies within sqrt(w - D^2) of it, w being its weight, and at most what lies within sqrt(w - d^2).
/// Gaps that the former leave contain the gaps of each of the lines. Before a block is halved, runs are
/// forgotten that do not even by the latter reach into a gap, and those that nowhere reach as far into it as
/// another one does: of two points, which one is nearer changes at a plane (power diagrams; Chen, Panozzo
/// and Dumas 2018). Those that cannot be seen from a block do not come that far (PowerCellBounds). Small
/// blocks are not halved any more: what is left is united on all lines (SimdRunUnion).
class PrunedDilation {
  public:
    /// For blocks of so many layers, at most. What is covered is clipped to `extent`. `reaches` are those of
    /// most runs, and outlive this; `max_weight` bounds the weights of all.
    PrunedDilation(const LayerLattice& lattice, const BallExtentTable& reaches, Run extent,
                   std::int32_t max_layers, double max_weight);

    /// Grows the lines of a block of a stack of layers.
    void grow(const LineBlock& block, std::span<const WeightedRows* const> layers);
    /// A grown line of the block, counted from its first.
    std::span<const Run> line(std::int32_t layer, std::int32_t line) const {
        const LineRuns& at = line_runs_[line_index(layer, line)];
        return {runs_.data() + at.from, at.count};
    }

  private:
    /// What may reach into the gaps of a block.
    struct Level {
        std::vector<SourceLine> lines;
        std::vector<WeightedRun> runs;  // of the lines
        std::vector<Run> covered;       // anyway
    };
    struct Source {
        const SourceLine* line;
        const WeightedRun* run;
    };
    /// One that reaches into a gap, and all it covers in the block.
    struct Visible {
        Source source;
        Run most;
        const Run* meets;  // if it sticks out of a covered run
    };
    /// About the farthest that sticks out of a covered run on either side.
    struct Champions {
        Source left, right;
        std::int32_t least, greatest;  // twice their ends, about
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
    double layer_square_, row_square_;  // of its pitches
    double max_weight_;
    const BallExtentTable& ball_;
    LineBlock block_{};
    std::vector<Level> levels_;  // by how often a block was halved
    RunUnion union_;
    CoverTable table_;
    SimdRunUnion small_;  // blocks that are not halved
    std::vector<Run> covered_;
    std::vector<ExtentBounds> reaches_;
    std::vector<std::vector<std::int32_t>> farthest_;  // reaches, by layers and lines away from a block
    std::vector<BlockOffset> aside_;                   // the block, from lines about it
    std::int32_t farthest_lines_ = 0;                  // of the block for which they were listed
    std::vector<std::uint32_t> uncovered_;
    std::vector<Visible> visible_;
    std::vector<Champions> champions_;
    std::vector<Run> runs_;
    std::vector<LineRuns> line_runs_;
};

}  // namespace lamella
