// FaultList: insertion into a sorted list of bounded length.
#include "engine/checks/fault_list.h"

#include <algorithm>
#include <cmath>

namespace lamella {
namespace {

bool worse(const Fault& a, const Fault& b) {
    if (a.size != b.size) return a.size > b.size;
    if (a.at.z != b.at.z) return a.at.z < b.at.z;
    if (a.at.y != b.at.y) return a.at.y < b.at.y;
    return a.at.x < b.at.x;
}

}  // namespace

Box CheckGrid::box(const ComponentExtent& extent) const {
    const dvec2 lo = on_band(band, extent.along.begin, extent.first_row),
                hi = on_band(band, extent.along.end, extent.last_row + 1);
    return {{lo, z0 + layers.bottom(extent.first_layer)}, {hi, z0 + layers.top(extent.last_layer)}};
}

void CheckGrid::weigh(LabelledLayer& labelled, int layer) const {
    if (layers.equal()) return;
    const std::int64_t weight = std::llround(layers.height(layer) / unit_height());
    for (ComponentExtent& component : labelled.components) component.length *= weight;
}

Fault CheckGrid::fault(const StreamingComponent& component) const {
    Fault fault = this->fault(component.largest);
    fault.first_layer = component.extent.first_layer;
    fault.end_layer = component.extent.last_layer + 1;
    fault.box = box(component.extent);
    return fault;
}

Fault CheckGrid::fault(const LayerPatch& patch) const {
    Fault fault;
    const LayerPatch::Point middle = patch.middle();
    fault.at = {on_band(band, middle.along, middle.row + 0.5), plane(patch.layer)};
    fault.layer = fault.first_layer = patch.layer;
    fault.end_layer = patch.layer + 1;
    ComponentExtent extent;
    for (const PlacedRun& run : patch.runs)
        extent.include({0, {run.begin, run.end}, run.row, run.row, run.layer, run.layer});
    fault.box = box(extent);
    fault.runs = patch.runs;
    return fault;
}

void FaultList::add(Fault fault) {
    ++count_;
    total_ += fault.size;
    const auto place = std::ranges::upper_bound(worst_, fault, worse);
    if (place == worst_.end() && worst_.size() > most_) return;
    worst_.insert(place, std::move(fault));
    if (worst_.size() > most_ + 1) worst_.pop_back();
}

void FaultList::excuse_greatest() {
    if (worst_.empty()) return;
    --count_;
    total_ -= worst_.front().size;
    worst_.erase(worst_.begin());
}

void FaultList::report(CheckResult& result) const {
    result.count = count_;
    result.total = total_;
    result.worst = worst_;
    if (result.worst.size() > most_) result.worst.resize(most_);
}

}  // namespace lamella
