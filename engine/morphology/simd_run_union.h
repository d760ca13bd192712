// SimdRunUnion: the union of dilated runs on all lines of a small block at once.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/morphology/block_extents.h"
#include "engine/runs/run_union.h"

namespace lamella {

/// Runs of one line of a stack of layers.
struct SourceLine {
    std::int32_t layer, line;
    std::span<const WeightedRun> runs;
};

/// Union of dilated runs on all lines of a block, by SIMD over the lines: a few operations per run, whatever
/// it covers.
///
/// A run is filed under the cell, one pixel long, in which it begins before it is dilated. That cell is the
/// same for all lines. The runs of one cell that reach beyond the cell's end once dilated have one run as
/// their union: from the least begin to the greatest end. All runs left of a gap are filed under cells before
/// those of the runs right of it. So a gap lies between two cells such that all runs up to the first one have
/// ended and none from the second one on has begun.
class SimdRunUnion {
  public:
    static constexpr std::int32_t edge = BallExtentTable::edge;
    static constexpr std::size_t max_lines = static_cast<std::size_t>(edge) * edge;

    /// Blocks have at most `max_layers` layers (<= `edge`) of at most `edge` lines. Results are clipped to
    /// `extent`. `reaches` should be the table of the most frequent radius and must outlive this object.
    SimdRunUnion(const LayerLattice& lattice, const BallExtentTable& reaches, Run extent,
                 std::int32_t max_layers);

    /// Begins a block.
    void begin(const LineBlock& block) { block_ = block; }
    /// Adds the runs number [from, to) of a layer. They lie on lines that balls of the table reach the block
    /// from.
    void add(const WeightedRows& rows, std::int32_t layer, std::size_t from, std::size_t to);
    void add(std::span<const SourceLine> lines);
    /// Adds runs to all lines of the block, without dilating them.
    void add_covered(std::span<const Run> runs);
    /// Computes the union of all runs added since begin().
    void unite();
    /// Returns the runs of a line: sorted, disjoint and not touching. Layer and line are counted from the
    /// block's first.
    std::span<const Run> line(std::int32_t layer, std::int32_t line) const {
        return lines_[place(layer, line)];
    }

    /// Returns the index of a line, counted from the block's first, among max_lines.
    static std::size_t place(std::int32_t layer, std::int32_t line) {
        return static_cast<std::size_t>(layer) * edge + static_cast<std::size_t>(line);
    }
    enum class Use : std::uint8_t { none, some };
    using Lines = std::array<std::vector<Run>, max_lines>;
    /// The union of a cell's runs on each line of a layer.
    struct alignas(64) Covered {
        std::array<std::int32_t, edge> begins;  // negated, so that a maximum updates both
        std::array<std::int32_t, edge> ends;
    };
    struct Cells {
        Run extent;
        std::size_t layers;            // layers per cell, a power of two
        std::vector<Covered> covered;  // by cell, then by layer
        std::vector<Use> used;         // by cell, padded to whole words
        Lines short_runs;              // dilated runs that end within their cell

        std::size_t cell_of(std::int32_t at) const {
            return static_cast<std::uint32_t>(at - extent.begin) / run_unit;
        }
        std::int32_t end_of(std::size_t cell) const {
            return extent.begin + static_cast<std::int32_t>(cell + 1) * run_unit;
        }
        Covered* layers_of(std::size_t cell) { return covered.data() + cell * layers; }
    };

  private:
    void list_used();

    LayerLattice lattice_;
    const BallExtentTable& reaches_;
    LineBlock block_{};
    Cells cells_;
    std::vector<std::uint32_t> used_cells_;
    Lines lines_;
    RunUnion with_short_;
};

}  // namespace lamella
