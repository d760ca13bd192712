// An index of things in a layer's plane by the bands of lines they meet, rows and columns alike.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "engine/interval_index.h"
#include "engine/runs.h"

namespace lamella {

/// Finds the items that a band's lines can meet, wherever along them, also outside the band. They come back
/// sorted along the lines.
class PlaneIndex {
  public:
    PlaneIndex() = default;
    /// One rectangle an item, mm.
    explicit PlaneIndex(std::vector<Rect> rects);

    /// Replaces `items` by the numbers of the items whose extent across the lines meets the band's.
    void query(const RowBand& band, std::vector<std::uint32_t>& items) const;
    const Rect& rect(std::uint32_t item) const { return rects_[item]; }
    /// Encloses all rectangles.
    const Rect& bounds() const { return bounds_; }

  private:
    /// The items by one coordinate; sorting them is worth putting off, as most layers are asked one way only.
    struct Direction {
        std::once_flag opened;
        IntervalIndex items;
    };
    const IntervalIndex& direction(int across) const;

    std::vector<Rect> rects_;
    std::unique_ptr<Direction[]> directions_;  ///< by the coordinate that differs between lines
    Rect bounds_;
};

}  // namespace lamella
