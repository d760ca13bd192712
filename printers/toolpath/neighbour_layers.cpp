// Traces each section once, and intersects sections.
#include "printers/toolpath/neighbour_layers.h"

#include <utility>

namespace lamella {

std::shared_ptr<NeighbourLayers::Entry> NeighbourLayers::entry(int index, const CancelToken* cancel) const {
    std::shared_ptr<Entry> entry;
    {
        const std::lock_guard lock(mutex_);
        std::shared_ptr<Entry>& held = entries_[index];
        if (!held) held = std::make_shared<Entry>();
        entry = held;
    }
    std::call_once(entry->traced, [&] {
        const Layer layer(*job_, index, cancel);
        entry->outlines = {layer.contours(tolerance_), layer.support_contours(tolerance_)};
    });
    return entry;
}

std::shared_ptr<const LayerOutlines> NeighbourLayers::outlines(int index, const CancelToken* cancel) const {
    const std::shared_ptr<Entry> entry = this->entry(index, cancel);
    return {entry, &entry->outlines};
}

LayerBelow NeighbourLayers::footing(int index, double pitch, const CancelToken* cancel) const {
    const auto below = outlines(index - 1, cancel);
    Polygons section = to_polygons(below->part);
    if (!below->supports.empty()) section = unite_polygons(section, to_polygons(below->supports));
    return {std::move(section), pitch};
}

PlacedPolygons NeighbourLayers::core(int index, int below, int above, const CancelToken* cancel) const {
    const LayerPlan& layers = job_->layers;
    const int stack = layers.stack_of(index);
    if (index - below < layers.first_of_stack(stack) || index + above >= layers.first_of_stack(stack + 1))
        return {};
    Polygons common;
    bool first = true;
    for (int i = index - below; i <= index + above; ++i) {
        if (i == index) continue;
        const std::shared_ptr<Entry> layer = entry(i, cancel);
        std::call_once(layer->simplified,
                       [&] { layer->coarse = simplified(to_polygons(layer->outlines.part), tolerance_); });
        stop_if_cancelled(cancel);
        common = std::exchange(first, false) ? layer->coarse : intersect_polygons(common, layer->coarse);
        if (common.empty()) break;
    }
    return PlacedPolygons(std::move(common));
}

void NeighbourLayers::forget_below(int index) {
    const std::lock_guard lock(mutex_);
    entries_.erase(entries_.begin(), entries_.lower_bound(index));
}

}  // namespace lamella
