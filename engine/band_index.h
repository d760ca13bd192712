// An index of things in a plane by the bands of lines they meet.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/geometry.h"

namespace lamella {

/// Finds the items whose extent across the lines meets an interval. Items come back sorted along the lines,
/// so that runs made from them are nearly sorted already.
class BandIndex {
  public:
    BandIndex() = default;
    /// across: each item's extent across the lines, mm (empty ones are never found); along: where it begins
    /// along them.
    BandIndex(const std::vector<Interval>& across, const std::vector<double>& along);

    /// Replaces `items` by the numbers of the items that meet the interval, in ascending order of `along`.
    void query(const Interval& interval, std::vector<std::uint32_t>& items) const;

  private:
    std::size_t bin_of(double v) const;

    Interval extent_;
    double bins_per_mm_ = 0;
    std::size_t bins_ = 0;
    std::vector<Interval> across_;       ///< by rank along the lines
    std::vector<std::uint32_t> item_;    ///< item number of each rank
    std::vector<std::uint32_t> starts_;  ///< first entry of each bin, bins + 1 of them
    std::vector<std::uint32_t> ranks_;   ///< the ranks of each bin, ascending
};

}  // namespace lamella
