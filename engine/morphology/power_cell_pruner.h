// PowerCellPruner: bounds each run's power cell by the runs on adjacent lines, to drop runs that cannot be
// visible.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/morphology/weighted_rows.h"

namespace lamella {

/// Sets the PowerCellBounds of runs from the runs on adjacent lines, before anything is dilated.
class PowerCellPruner {
  public:
    /// `max_weight` is an upper bound of all weights.
    PowerCellPruner(const LayerLattice& lattice, double max_weight);

    /// Bounds the power cells of a layer's runs by adjacent lines of that layer.
    void limit(WeightedRows& layer) const;
    /// Bounds the power cells of lines [first, end) of two adjacent layers by each other.
    void limit(WeightedRows& below, WeightedRows& above, std::size_t first, std::size_t end) const;

  private:
    /// A lookup table: how many lines away a run's end may be visible past a run on the adjacent line, by the
    /// distance by which it sticks out (run units).
    class EndSight {
      public:
        EndSight(double pitch, double max_weight);
        std::uint8_t lines(std::int32_t ahead) const {
            const auto entry = static_cast<std::uint32_t>(std::max(ahead, 0) + (step - 1)) / step;
            return lines_[std::min(entry, last_)];
        }

      private:
        static constexpr std::int32_t step = 8;  // between entries, run units
        std::vector<std::uint8_t> lines_;
        std::uint32_t last_;
    };
    /// Two adjacent lines.
    struct Pair;
    static void limit(const Pair& pair, const EndSight& sight);

    EndSight across_, up_;
};

}  // namespace lamella
