// RowBitmask: a layer as a bit mask, 64 cells a word, used to cull runs before exact tests.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/runs/runs.h"

namespace lamella {

/// Where the cells of a layer lie. A cell is as long as a row is wide.
struct CellLattice {
    static constexpr std::int32_t cell = run_unit;   ///< length along the lines, run units
    static constexpr std::int32_t word_cells = 64;   ///< in a word
    static constexpr std::size_t lines_at_once = 8;  ///< there is a multiple of it

    std::int32_t first = 0;        ///< where the first cell of each line begins, run units
    std::size_t words = 0;         ///< of a line
    std::size_t lines = 0;         ///< the margin's included
    std::size_t margin_lines = 0;  ///< before the layer's first line, and as many at least behind its last

    /// The cells of so many rows a `row_pitch` apart, whose runs lie within an extent, and of what lies no
    /// further than `reach` beside them; run units.
    CellLattice(Run extent, std::size_t row_count, double reach, double row_pitch);
    friend bool operator==(const CellLattice&, const CellLattice&) = default;
};

/// How many cells a disc reaches to either side, by how many lines away.
using DiscWidths = std::vector<std::int32_t>;
/// A disc about each point of a cell covers at least these cells wholly.
DiscWidths inner_disc(double radius, double row_pitch);
/// A disc about any point of a cell meets at most these cells.
DiscWidths outer_disc(double radius, double row_pitch);

/// A set of cells, a bit for each. Beside the lattice there are none.
///
/// Words lie column by column, so that many lines are worked on at once without a bit crossing lanes.
class RowBitmask {
  public:
    explicit RowBitmask(const CellLattice& lattice);
    const CellLattice& lattice() const { return lattice_; }
    /// The words with these cells of every line, one after another; there are lines_at_once empty ones before
    /// them and behind.
    std::uint64_t* column(std::size_t word) { return words_.data() + place(word); }
    const std::uint64_t* column(std::size_t word) const { return words_.data() + place(word); }

    /// Adds the cells [first, end) of a line, if there are any.
    void mark(std::int32_t first, std::int32_t end, std::size_t line);
    /// Turns into all other cells of the lattice.
    void invert();
    /// These and all cells within a disc of them.
    RowBitmask grown(const DiscWidths& disc) const;
    /// The cells of the lattice that are not within a disc of these.
    RowBitmask beyond(const DiscWidths& disc) const;
    /// Takes away those within a disc of the cells of another set on the same lattice.
    void subtract_dilated(const RowBitmask& other, const DiscWidths& disc);
    /// The cells of so many lines as runs, joined where they touch. Quick where there are few.
    RunRows runs(std::size_t first_line, std::size_t count) const;
    /// What of rows lies in the cells. Their first line is that one of the lattice.
    RunRows clip(const RunRows& rows, std::size_t first_line) const;

  private:
    std::size_t place(std::size_t word) const { return word * stride_ + CellLattice::lines_at_once; }

    CellLattice lattice_;
    std::size_t stride_;  // from column to column
    std::vector<std::uint64_t> words_;
};

/// The cells of a layer's runs; its first line follows those of the margin.
struct LayerCells {
    RowBitmask inner;  ///< by runs, wholly
    RowBitmask outer;  ///< by runs

    LayerCells(const RunRows& rows, const CellLattice& lattice);
};

}  // namespace lamella
