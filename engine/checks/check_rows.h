// The rows that a check looks at: lines of its own, or some of those that masks are made of.
#pragma once

#include <optional>

#include "engine/layers/layer.h"

namespace lamella {

/// Rows of a job's layers, as far apart as their run coordinates' pixels are wide, with a row and a pixel of
/// void all round.
class CheckRows {
  public:
    /// Along x, `pitch` mm apart.
    CheckRows(const Job& job, double pitch);
    /// On lines that other back-ends go through (Layer::cache_lines), with their step.
    CheckRows(const Job& job, const RowBand& lines);

    /// Of the rows: of positive pitches, a line a row.
    const RowBand& band() const { return band_; }
    /// Those of other back-ends.
    const std::optional<RowBand>& lines() const { return lines_; }
    RunRows part_rows(const Layer& layer, Scratch& scratch) const {
        return rows(layer.part(), layer, scratch);
    }
    /// Empty where there are none.
    RunRows support_rows(const Layer& layer, Scratch& scratch) const;

  private:
    RunRows rows(const SliceField& slice, const Layer& layer, Scratch& scratch) const;
    RunRows moved(const RunRows& found) const;

    RowBand band_;
    std::optional<RowBand> lines_;
};

}  // namespace lamella
