// Two interval indices, one for each direction of the lines.
#include "engine/plane_index.h"

namespace lamella {

PlaneIndex::PlaneIndex(std::vector<Rect> rects) : rects_(std::move(rects)) {
    std::vector<Interval> x, y;
    std::vector<double> lo_x, lo_y;
    for (const Rect& rect : rects_) {
        bounds_ = unite(bounds_, rect);
        x.push_back({rect.lo.x, rect.hi.x});
        y.push_back({rect.lo.y, rect.hi.y});
        lo_x.push_back(rect.lo.x);
        lo_y.push_back(rect.lo.y);
    }
    rows_ = IntervalIndex(y, lo_x);
    columns_ = IntervalIndex(x, lo_y);
}

void PlaneIndex::query(const RowBand& band, std::vector<std::uint32_t>& items) const {
    const Rect rect = band.rect();
    const bool row = band.axis == Axis::x;
    (row ? rows_ : columns_)
        .query(row ? Interval{rect.lo.y, rect.hi.y} : Interval{rect.lo.x, rect.hi.x}, items);
}

}  // namespace lamella
