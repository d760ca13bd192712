// Checks of single layers.
#include "engine/checks/layer_checks.h"

#include <algorithm>

namespace lamella {

void SheetCheck::add(LayerSample& sample, PreparedRows /*prepared*/) {
    const LabelledLayer& layer = sample.part;
    const int index = sample.index;
    if (layer.components.size() < 2) return;
    const auto largest = std::ranges::max_element(layer.components, {}, &ComponentExtent::length);
    const auto kept = static_cast<std::uint32_t>(largest - layer.components.begin());
    LayerPatch loose{.layer = index};
    for (int r = layer.first_row; r < layer.first_row + layer.rows(); ++r) {
        for (const LabelledRun& run : layer.row(r)) {
            if (run.component != kept) loose.include(PlacedRun{index, r, run.begin, run.end});
        }
    }
    Fault fault = grid_.fault(loose);
    fault.size = grid_.area(loose.length);
    faults_.add(std::move(fault));
}

void EmptyCheck::add(LayerSample& layer, PreparedRows /*prepared*/) {
    if (!layer.rows.printed().runs().empty()) return end_gap(layer.index);
    if (begin_ < 0) begin_ = layer.index;
}

void EmptyCheck::finish() { end_gap(grid_.layers.count()); }

void EmptyCheck::end_gap(int end) {
    if (begin_ < 0) return;
    Fault fault;
    fault.layer = fault.first_layer = begin_;
    fault.end_layer = end;
    const Rect plane = grid_.band.rect();
    const double lo = grid_.z0 + grid_.layers.bottom(begin_), hi = grid_.z0 + grid_.layers.bottom(end);
    fault.at = {(plane.lo + plane.hi) / 2.0, grid_.plane(begin_)};
    fault.size = hi - lo;
    fault.box = {{plane.lo, lo}, {plane.hi, hi}};
    faults_.add(std::move(fault));
    begin_ = -1;
}

void ReachCheck::add(LayerSample& layer, PreparedRows /*prepared*/) {
    const RunRows& rows = layer.rows.printed();
    const int index = layer.index;
    for (std::size_t l = 0; l < rows.lines(); ++l) {
        if (rows.line(l).empty()) continue;
        const int row = static_cast<int>(l);
        const Run first = rows.line(l).front(), last = rows.line(l).back();
        const PlacedRun placed{index, row, last.begin, last.end};
        if (last.end > extent_.along.end) along_ = placed;
        if (row > extent_.last_row || extent_.first_row > extent_.last_row) across_ = placed;
        if (index > extent_.last_layer) top_ = placed;
        extent_.include({0, {first.begin, last.end}, row, row, index, index});
    }
}

void ReachCheck::finish() {
    if (extent_.first_row > extent_.last_row) return;
    const dvec3 size = grid_.box(extent_).size();
    const glm::length_t along = grid_.band.axis == Axis::x ? 0 : 1, across = 1 - along;
    judge(along, size[along], along_);
    judge(across, size[across], across_);
    // Heights count from the bed, even if the first layers are empty.
    judge(2, grid_.layers.top(extent_.last_layer), top_);
}

void ReachCheck::judge(glm::length_t axis, double size, const PlacedRun& end) {
    // Extents across rows and layers are exact to one row or layer.
    const bool is_along = axis == (grid_.band.axis == Axis::x ? 0 : 1);
    const double known = axis == 2  ? grid_.layers.height(end.layer)
                         : is_along ? 1e-6
                                    : grid_.band.across_pitch;
    if (size <= build_volume_[axis] + known) return;
    LayerPatch patch{.layer = end.layer};
    patch.include(end);
    Fault fault = grid_.fault(patch);
    fault.size = size - build_volume_[axis];
    if (is_along) fault.at[axis] = grid_.band.along(end.end);
    faults_.add(std::move(fault));
}

}  // namespace lamella
