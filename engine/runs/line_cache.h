// Cache of lines that one back-end renders and another one reuses.
#pragma once

#include "engine/runs/runs.h"

namespace lamella {

/// Keeps some lines of a solid as bands of them are asked for, from the first row on.
class LineCache {
  public:
    /// The lines of `wanted`, which may have a step.
    explicit LineCache(const RowBand& wanted) : wanted_(wanted) {}

    const RowBand& wanted() const { return wanted_; }
    /// A band and its rows. It follows those that were added before, and what lies between them is empty.
    /// Without effect where its lines are none of the wanted band's.
    void add(const RowBand& band, const RunRows& rows);
    /// There is nothing behind the bands that were added, which were all like this one.
    void finish(const RowBand& band);
    /// All of the lines wanted; null until they are known.
    const RunRows* rows() const { return finished_ ? &rows_ : nullptr; }

  private:
    RowBand wanted_;
    RunRows rows_;
    bool finished_ = false;
};

}  // namespace lamella
