// LayerBelow: rows of intervals through the layer below.
#include "printers/toolpath/layer_below.h"

#include <algorithm>
#include <cmath>

namespace lamella {

LayerBelow::LayerBelow(Polygons below, double pitch)
    : section_(std::move(below)), pitch_(pitch), starts_(1, 0) {
    const Rect box = box_of(section_.all());
    if (box.empty()) return;
    first_ = box.lo.y;
    const auto rows = static_cast<std::size_t>(box.size().y / pitch) + 1;
    starts_.reserve(rows + 1);
    for (const Segment& s : cut_lines(section_.all(), {1, 0}, first_, pitch, static_cast<int>(rows))) {
        const auto row = static_cast<std::size_t>(std::lround((s.a.y - first_) / pitch));
        while (starts_.size() <= row) starts_.push_back(solid_.size());
        solid_.push_back({s.a.x, s.b.x});
    }
    starts_.resize(rows + 1, solid_.size());
}

bool LayerBelow::holds(dvec2 p) const {
    const double row = std::round((p.y - first_) / pitch_);
    if (!(row >= 0 && row + 1 < static_cast<double>(starts_.size()))) return false;
    const auto at = solid_.begin() + static_cast<std::ptrdiff_t>(starts_[static_cast<std::size_t>(row)]);
    const auto end = solid_.begin() + static_cast<std::ptrdiff_t>(starts_[static_cast<std::size_t>(row) + 1]);
    const auto after = std::upper_bound(at, end, p.x, [](double x, const Interval& i) { return x < i.lo; });
    return after != at && p.x <= std::prev(after)->hi;
}

}  // namespace lamella
