// RowBitmask: a layer as a bit mask, 64 cells a word, used to cull runs before exact tests.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/runs/runs.h"

namespace lamella {

/// The lattice of a layer's cells. A cell is one row wide and one pixel long.
struct CellLattice {
    static constexpr std::int32_t cell = run_unit;   ///< length along the lines, run units
    static constexpr std::int32_t word_cells = 64;   ///< cells in a word
    static constexpr std::size_t lines_at_once = 8;  ///< `lines` is a multiple of it

    std::int32_t first = 0;  ///< begin of the first cell of each line, run units
    std::size_t words = 0;   ///< words of a line
    std::size_t lines = 0;   ///< number of lines, including the margin
    std::size_t margin_lines =
        0;  ///< lines before the layer's first one, and at least as many after its last

    /// Covers `row_count` rows, `row_pitch` apart, whose runs lie within `extent`, and all points within
    /// `reach` of them. Lengths in run units.
    CellLattice(Run extent, std::size_t row_count, double reach, double row_pitch);
    friend bool operator==(const CellLattice&, const CellLattice&) = default;
};

/// A structuring element: how many cells a disc reaches to either side, by distance in lines.
using DiscWidths = std::vector<std::int32_t>;
/// Returns a lower bound of a cell's dilation: the cells that the discs about all points of the cell cover
/// wholly. Lengths in run units.
DiscWidths inner_disc(double radius, double row_pitch);
/// Returns an upper bound: all cells that a disc about any point of the cell meets.
DiscWidths outer_disc(double radius, double row_pitch);

/// A set of cells of a lattice, one bit per cell. Outside the lattice there are no cells.
///
/// Words are stored column by column, so that SIMD works on several lines at once and no bit crosses lanes.
class RowBitmask {
  public:
    explicit RowBitmask(const CellLattice& lattice);
    const CellLattice& lattice() const { return lattice_; }
    /// Returns the words number `word` of all lines, one after another. At least lines_at_once empty words
    /// lie before and after them.
    std::uint64_t* column(std::size_t word) { return words_.data() + place(word); }
    const std::uint64_t* column(std::size_t word) const { return words_.data() + place(word); }

    /// Adds the cells [first, end) of a line. Does nothing if the range is empty.
    void mark(std::int32_t first, std::int32_t end, std::size_t line);
    /// Replaces the set by its complement within the lattice.
    void invert();
    /// Returns the dilation by `disc`.
    RowBitmask grown(const DiscWidths& disc) const;
    /// Returns the complement, within the lattice, of the dilation by `disc`.
    RowBitmask beyond(const DiscWidths& disc) const;
    /// Removes the dilation of `other` by `disc`. Both sets are on the same lattice.
    void subtract_dilated(const RowBitmask& other, const DiscWidths& disc);
    /// Converts the cells of `count` lines to runs, joined where they touch. Quick if there are few cells.
    RunRows runs(std::size_t first_line, std::size_t count) const;
    /// Returns the parts of `rows` that lie in the cells. Their first line is line `first_line` of the
    /// lattice.
    RunRows clip(const RunRows& rows, std::size_t first_line) const;

  private:
    std::size_t place(std::size_t word) const { return word * stride_ + CellLattice::lines_at_once; }

    CellLattice lattice_;
    std::size_t stride_;  // words from column to column
    std::vector<std::uint64_t> words_;
};

/// Two bit masks of a layer, its lower and upper bound. The layer's first line follows the margin's lines.
struct LayerCells {
    RowBitmask inner;  ///< cells that runs cover wholly
    RowBitmask outer;  ///< cells that runs meet

    LayerCells(const RunRows& rows, const CellLattice& lattice);
};

}  // namespace lamella
