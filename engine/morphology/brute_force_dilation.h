// BruteForceDilation: dilates a few neighbouring lines by uniting every run within reach of them.
#pragma once

#include <span>
#include <vector>

#include "engine/morphology/simd_run_union.h"

namespace lamella {

/// Dilation of small blocks of lines by brute force. The cost is proportional to the number of runs within
/// reach of the ball. For small balls that is cheaper than to find and drop the hidden runs (PrunedDilation).
class BruteForceDilation {
  public:
    /// Blocks have at most `max_layers` layers and SimdRunUnion::edge lines. Dilated runs are clipped to
    /// `extent`. `reaches` should be the table of the most frequent radius and must outlive this object.
    /// `max_weight` is an upper bound of all weights.
    BruteForceDilation(const LayerLattice& lattice, const BallExtentTable& reaches, Run extent,
                       std::int32_t max_layers, double max_weight);

    /// Dilates the lines of one block of a stack of layers.
    void grow(const LineBlock& block, std::span<const WeightedRows* const> layers);
    /// Returns a dilated line; layer and line are counted from the block's first. Valid until the next
    /// grow().
    std::span<const Run> line(std::int32_t layer, std::int32_t line) const {
        return union_.line(layer, line);
    }

  private:
    std::vector<std::size_t> beside_;  // number of lines in reach to either side, by distance in layers
    SimdRunUnion union_;
};

}  // namespace lamella
