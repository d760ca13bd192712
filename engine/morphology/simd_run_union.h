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

/// Unites grown runs on the lines of a block, by SIMD over the lines: a few operations a run, whatever it
/// covers.
///
/// A run is kept by the cell, a pixel long, that it begins in before it grows, which is the same for all
/// lines. Of those of a cell that grow beyond its end, the union is one run: from the least begin to the
/// greatest end. A gap has what begins before it in cells before those of what begins behind it; so it lies
/// between two cells where all up to the first have ended and nothing from the second on has begun.
class SimdRunUnion {
  public:
    static constexpr std::int32_t edge = BallExtentTable::edge;
    static constexpr std::size_t max_lines = static_cast<std::size_t>(edge) * edge;

    /// For blocks of at most so many layers, themselves at most `edge`, of `edge` lines. Lines are clipped to
    /// `extent`. `reaches` are those of most runs, and outlive this.
    SimdRunUnion(const LayerLattice& lattice, const BallExtentTable& reaches, Run extent,
                 std::int32_t max_layers);

    /// Begins a block.
    void begin(const LineBlock& block) { block_ = block; }
    /// Adds runs of a layer's rows, those at [from, to) of them, on lines that balls of the table reach.
    void add(const WeightedRows& rows, std::int32_t layer, std::size_t from, std::size_t to);
    void add(std::span<const SourceLine> lines);
    /// Adds what is covered on all lines of the block, as it is.
    void add_covered(std::span<const Run> runs);
    /// Unites all that was added.
    void unite();
    /// The runs of a line, counted from the block's first: sorted, disjoint and not touching.
    std::span<const Run> line(std::int32_t layer, std::int32_t line) const {
        return lines_[place(layer, line)];
    }

    /// Of a line, counted from the block's first, among max_lines.
    static std::size_t place(std::int32_t layer, std::int32_t line) {
        return static_cast<std::size_t>(layer) * edge + static_cast<std::size_t>(line);
    }
    enum class Use : std::uint8_t { none, some };
    using Lines = std::array<std::vector<Run>, max_lines>;
    /// What runs of a cell cover of the lines of a layer.
    struct alignas(64) Covered {
        std::array<std::int32_t, edge> begins;  // times -1, so that both grow
        std::array<std::int32_t, edge> ends;
    };
    struct Cells {
        Run extent;
        std::size_t layers;            // of each cell
        std::vector<Covered> covered;  // cell by cell, and in each layer by layer
        std::vector<Use> used;         // cells, filled up to whole words
        Lines short_runs;              // those that do not grow beyond the end of their cell

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
