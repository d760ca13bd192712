// CoarseCells: a layer as a bit mask whose cells cover several rows, to find candidates quickly.
#pragma once

#include "engine/morphology/row_bitmask.h"

namespace lamella {

/// The cells, `scale` pitches long and as many rows wide, that hold some of a layer and some of the void.
class CoarseCells {
  public:
    /// Cells are known up to `reach` beside the rows, run units.
    CoarseCells(const RunRows& rows, std::int32_t scale, double reach, double row_pitch);

    const RowBitmask& solid() const { return solid_; }
    const RowBitmask& voids() const { return void_; }
    /// Rows that are known on either side of the layer's.
    std::size_t margin() const { return solid_.lattice().margin_lines * static_cast<std::size_t>(scale_); }
    /// Cells of the lattice as runs of the layer's rows and the margin's, run units.
    RunRows rows_of(const RowBitmask& cells) const;

  private:
    void add(std::int32_t begin, std::int32_t end, std::size_t line, RowBitmask& to);

    std::int32_t scale_;
    std::size_t row_count_;
    RowBitmask solid_, void_;
};

}  // namespace lamella
