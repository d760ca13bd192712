// BruteForceDilation: dilates a few neighbouring lines by looking at every run around them.
#pragma once

#include <span>
#include <vector>

#include "engine/morphology/simd_run_union.h"

namespace lamella {

/// Grows small blocks of lines by brute force: the cost is that of all runs that a ball reaches. For small
/// balls that is less than it takes to find out which of them make no difference (PrunedDilation).
class BruteForceDilation {
  public:
    /// For blocks of so many layers, at most, of SimdRunUnion::edge lines. What is grown is clipped to
    /// `extent`. `reaches` are those of most runs, and outlive this; `max_weight` bounds the weights of all.
    BruteForceDilation(const LayerLattice& lattice, const BallExtentTable& reaches, Run extent,
                       std::int32_t max_layers, double max_weight);

    /// Grows the lines of a block of a stack of layers.
    void grow(const LineBlock& block, std::span<const WeightedRows* const> layers);
    /// A grown line of the block, counted from its first.
    std::span<const Run> line(std::int32_t layer, std::int32_t line) const {
        return union_.line(layer, line);
    }

  private:
    std::vector<std::size_t> beside_;  // how many lines are reached to either side, by layers away
    SimdRunUnion union_;
};

}  // namespace lamella
