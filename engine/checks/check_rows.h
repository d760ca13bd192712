// CheckRows: the rows that a check samples: lines of its own, or some of the lines that masks are made of.
#pragma once

#include <optional>

#include "engine/layers/layer.h"

namespace lamella {

/// Rows of a job's layers with equal pitches along and across, surrounded by a row and a pixel of void.
class CheckRows {
  public:
    /// Samples rows along x, `pitch` mm apart.
    CheckRows(const Job& job, double pitch);
    /// Samples lines that other back-ends go through as well (Layer::cache_lines), with their step.
    CheckRows(const Job& job, const RowBand& lines);

    /// Returns the band of the rows. Its pitches are positive; it has one line per row.
    const RowBand& band() const { return band_; }
    /// Returns the lines shared with other back-ends; empty if there are none.
    const std::optional<RowBand>& lines() const { return lines_; }
    RunRows part_rows(const Layer& layer, Scratch& scratch) const {
        return rows(layer.part(), layer, scratch);
    }
    /// Returns empty rows if the job has no supports.
    RunRows support_rows(const Layer& layer, Scratch& scratch) const;

  private:
    RunRows rows(const SliceField& slice, const Layer& layer, Scratch& scratch) const;
    RunRows moved(const RunRows& found) const;

    RowBand band_;
    std::optional<RowBand> lines_;
};

}  // namespace lamella
