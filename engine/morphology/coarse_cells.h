// CoarseCells: a layer as a bit mask whose cells cover several rows, to find candidates quickly.
#pragma once

#include "engine/morphology/row_bitmask.h"

namespace lamella {

/// Two bit masks of a layer: the cells that meet the solid and the cells that meet the void. A cell is
/// `scale` pixels long and `scale` rows wide. A cell may be in both masks.
class CoarseCells {
  public:
    /// The lattice covers the rows and what lies within `reach` (run units) of them.
    CoarseCells(const RunRows& rows, std::int32_t scale, double reach, double row_pitch);

    const RowBitmask& solid() const { return solid_; }
    const RowBitmask& voids() const { return void_; }
    /// Returns the number of rows that the lattice has before the layer's first row.
    std::size_t margin() const { return solid_.lattice().margin_lines * static_cast<std::size_t>(scale_); }
    /// Converts cells to runs (run units) on the layer's rows, with margin() rows before and behind them.
    RunRows rows_of(const RowBitmask& cells) const;

  private:
    void add(std::int32_t begin, std::int32_t end, std::size_t line, RowBitmask& to);

    std::int32_t scale_;
    std::size_t row_count_;
    RowBitmask solid_, void_;
};

}  // namespace lamella
