// An index of things by an interval they occupy: beams across the lines of a layer, triangles over the
// height.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/geometry.h"

namespace lamella {

/// Finds the items whose interval meets another. Items come back sorted by a key; with the position along the
/// lines as the key, runs made from them are nearly sorted already.
class IntervalIndex {
  public:
    IntervalIndex() = default;
    /// intervals: one an item (empty ones are never found); keys: what the items are sorted by.
    IntervalIndex(const std::vector<Interval>& intervals, const std::vector<double>& keys);

    /// Replaces `items` by the numbers of the items whose interval meets this one, in ascending order of
    /// their keys.
    void query(const Interval& interval, std::vector<std::uint32_t>& items) const;

  private:
    std::size_t bin_of(double v) const;

    Interval extent_;
    double bins_per_mm_ = 0;
    std::size_t bins_ = 0;
    std::vector<Interval> intervals_;    ///< by rank
    std::vector<std::uint32_t> item_;    ///< item number of each rank
    std::vector<std::uint32_t> starts_;  ///< first entry of each bin, bins + 1 of them
    std::vector<std::uint32_t> ranks_;   ///< the ranks of each bin, ascending
};

}  // namespace lamella
