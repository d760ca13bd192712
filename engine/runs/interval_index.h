// Index of items by the interval they occupy: beams across the lines of a layer, triangles over the height.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/geometry.h"

namespace lamella {

/// Finds the items whose interval intersects a query interval, sorted by a key. With the position along the
/// lines as the key, the runs made from the items are nearly sorted already.
class IntervalIndex {
  public:
    IntervalIndex() = default;
    /// `intervals`: one per item (items with empty ones are never found); `keys`: the sort key of each item.
    IntervalIndex(const std::vector<Interval>& intervals, const std::vector<double>& keys);

    /// Replaces `items` by the numbers of the items whose interval intersects this one, in ascending order of
    /// key.
    void query(const Interval& interval, std::vector<std::uint32_t>& items) const;

  private:
    std::size_t bin_of(double v) const;

    Interval extent_;
    double bins_per_mm_ = 0;
    std::size_t bins_ = 0;
    std::vector<Interval> intervals_;    ///< by rank, that is in order of the keys
    std::vector<std::uint32_t> item_;    ///< item number of each rank
    std::vector<std::uint32_t> starts_;  ///< first entry of each bin, bins + 1 of them
    std::vector<std::uint32_t> ranks_;   ///< the ranks of each bin, ascending
};

}  // namespace lamella
