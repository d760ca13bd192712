// Two interval indices, one for each direction of the lines, each built on first use.
#include "engine/solids/plane_index.h"

namespace lamella {

PlaneIndex::PlaneIndex(std::vector<Rect> rects)
    : rects_(std::move(rects)), directions_(std::make_unique<Direction[]>(2)) {
    for (const Rect& rect : rects_) bounds_ = unite(bounds_, rect);
}

const IntervalIndex& PlaneIndex::direction(int across) const {
    Direction& direction = directions_[static_cast<std::size_t>(across)];
    std::call_once(direction.opened, [&] {
        std::vector<Interval> extents;
        std::vector<double> begins;
        extents.reserve(rects_.size());
        begins.reserve(rects_.size());
        for (const Rect& rect : rects_) {
            extents.push_back({rect.lo[across], rect.hi[across]});
            begins.push_back(rect.lo[1 - across]);
        }
        direction.items = IntervalIndex(extents, begins);
    });
    return direction.items;
}

void PlaneIndex::query(const RowBand& band, std::vector<std::uint32_t>& items) const {
    items.clear();
    if (rects_.empty()) return;
    const Rect rect = band.rect();
    const int across = band.axis == Axis::x ? 1 : 0;
    direction(across).query({rect.lo[across], rect.hi[across]}, items);
}

}  // namespace lamella
