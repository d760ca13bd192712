// PlaneIndex: index of items in a layer's plane by the lines they meet, for rows and columns alike.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "engine/runs/interval_index.h"
#include "engine/runs/runs.h"
#include "engine/solids/line_frame.h"

namespace lamella {

/// Finds the items that a band's lines can meet, also beyond the ends of the band. Results are sorted along
/// the lines.
class PlaneIndex {
  public:
    PlaneIndex() = default;
    /// One rectangle per item, mm.
    explicit PlaneIndex(std::vector<Rect> rects);

    /// Replaces `items` by the numbers of the items whose extent across the lines meets the band's.
    void query(const RowBand& band, std::vector<std::uint32_t>& items) const;
    /// Calls visit(item, lines) for each item whose rectangle meets the band, with the lines that it meets.
    template <typename Visit>
    void visit(const RowBand& band, const LineRange& lines, const Visit& visit) const;
    const Rect& rect(std::uint32_t item) const { return rects_[item]; }
    /// Returns the bounding rectangle of all rectangles.
    const Rect& bounds() const { return bounds_; }

  private:
    /// The items by one coordinate, sorted on first use: most layers query one direction only.
    struct Direction {
        std::once_flag opened;
        IntervalIndex items;
    };
    const IntervalIndex& direction(int across) const;

    std::vector<Rect> rects_;
    std::unique_ptr<Direction[]> directions_;  ///< by the coordinate across the lines
    Rect bounds_;
};

template <typename Visit>
void PlaneIndex::visit(const RowBand& band, const LineRange& lines, const Visit& visit) const {
    const Rect rect = band.rect();
    const int along = band.axis == Axis::x ? 0 : 1, across = 1 - along;
    std::vector<std::uint32_t> items;
    query(band, items);
    for (const std::uint32_t item : items) {
        const Rect& met = rects_[item];
        if (met.hi[along] < rect.lo[along] || rect.hi[along] < met.lo[along]) continue;
        LineRange range = lines_across(band, {met.lo[across], met.hi[across]});
        range = {std::max(range.first, lines.first), std::min(range.last, lines.last)};
        if (range.first < range.last) visit(item, range);
    }
}

}  // namespace lamella
