// PowerCellPruner: bounds each run's power cell by the runs beside it, to drop what cannot be visible.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/morphology/weighted_rows.h"

namespace lamella {

/// Limits the sights of runs by the runs beside them, before balls are grown.
class PowerCellPruner {
  public:
    /// `max_weight` bounds the weights of all runs.
    PowerCellPruner(const LayerLattice& lattice, double max_weight);

    /// Limits sights within a layer.
    void limit(WeightedRows& layer) const;
    /// Limits those of lines [first, end) of two layers by each other.
    void limit(WeightedRows& below, WeightedRows& above, std::size_t first, std::size_t end) const;

  private:
    /// How far an end is seen beyond one on the next line, by how far it lies ahead of that.
    class EndSight {
      public:
        EndSight(double pitch, double max_weight);
        std::uint8_t lines(std::int32_t ahead) const {
            const auto entry = static_cast<std::uint32_t>(std::max(ahead, 0) + (step - 1)) / step;
            return lines_[std::min(entry, last_)];
        }

      private:
        static constexpr std::int32_t step = 8;  // from entry to entry, run units
        std::vector<std::uint8_t> lines_;
        std::uint32_t last_;
    };
    /// Two lines beside each other.
    struct Pair;
    static void limit(const Pair& pair, const EndSight& sight);

    EndSight across_, up_;
};

}  // namespace lamella
