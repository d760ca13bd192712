// VoidCheck: joins the void of each layer to that of the layer before.
#include "engine/checks/void_check.h"

#include "engine/runs/row_sets.h"

namespace lamella {
namespace {

constexpr std::uint32_t joined_outside = 1, on_bed = 2;

}  // namespace

PreparedRows VoidCheck::prepare(const LayerSample& layer) const {
    const RunRows voids = complement(layer.rows.part, 0, grid_.band.hi * run_unit);
    return {{}, label_layer(voids, layer.index, Growth{})};
}

bool VoidCheck::accepts(const PreparedRows& prepared, std::size_t lines) const {
    return prepared.labels.starts.size() == lines + 1 && !prepared.labels.row(0).empty();
}

void VoidCheck::add(LayerSample& layer, PreparedRows prepared) {
    LabelledLayer& voids = prepared.labels;
    ComponentTags tags;
    tags.flags.assign(voids.components.size(), layer.index == 0 ? on_bed : 0);
    tags.flags[voids.row(0).front().component] |= joined_outside;
    grid_.weigh(voids, layer.index);
    ended_.clear();
    voids_.add(std::move(voids), layer.index, tags, ended_);
    for (const EndedComponent& ended : ended_) judge(ended, false);
}

void VoidCheck::finish() {
    ended_.clear();
    voids_.finish(ended_);
    for (const EndedComponent& ended : ended_) judge(ended, true);
}

void VoidCheck::judge(const EndedComponent& ended, bool at_the_top) {
    const StreamingComponent& component = ended.component;
    if ((component.flags & joined_outside) != 0) return;
    if (ended.joined && (ended.joined_flags & joined_outside) == 0) return;
    const bool closed = !ended.joined && !at_the_top && (component.flags & on_bed) == 0;
    Fault fault = grid_.fault(component);
    fault.size = grid_.volume(component.extent.length);
    if (closed) {
        if (fault.size >= min_cavity_) cavities_.add(std::move(fault));
    } else if (fault.size >= min_cup_) {
        cups_.add(std::move(fault));
    }
}

}  // namespace lamella
