// Cache of lines that one back-end renders and another one reuses.
#pragma once

#include "engine/runs/runs.h"

namespace lamella {

/// Keeps selected lines of a solid while bands of lines stream by in order, from the first row on.
class LineCache {
  public:
    /// Keeps the lines of `wanted`, which may have a step.
    explicit LineCache(const RowBand& wanted) : wanted_(wanted) {}

    const RowBand& wanted() const { return wanted_; }
    /// Adds a band and its runs. Bands come in order; lines between them are empty. Has no effect when the
    /// band's line numbering differs from that of the wanted band.
    void add(const RowBand& band, const RunRows& rows);
    /// Ends the stream: no band follows. `band` is any of the bands added; they all share its line numbering.
    void finish(const RowBand& band);
    /// Returns all wanted lines; null until finish() was called.
    const RunRows* rows() const { return finished_ ? &rows_ : nullptr; }

  private:
    RowBand wanted_;
    RunRows rows_;
    bool finished_ = false;
};

}  // namespace lamella
