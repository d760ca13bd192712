// Printable enclosures: sweeps down and up over a stack of layers.
#include "engine/surveys/printable_enclosure.h"

#include "engine/base/error.h"
#include "engine/morphology/layer_offset.h"
#include "engine/runs/row_sets.h"

namespace lamella {
namespace {

RunRows grown(const RunRows& rows, double by, double row_pitch) {
    RunRows out;
    grow_rows(WeightedRows(rows, by), row_pitch, out);
    return out;
}

/// Returns the union of a layer and the erosion of a neighbouring layer by a step.
RunRows with_inside_of(const RunRows& layer, const RunRows& beside, const EnclosureRule& rule) {
    RunRows inside, out;
    shrink_rows(beside, rule.step, rule.row_pitch, inside);
    unite(layer, inside, out);
    return out;
}

/// Returns the parts of the layer above that stand out too far over this layer. Half a row is added to the
/// limit, because a row that grazes an outline may be missed by a disc by a part of a row.
RunRows hanging_over(const RunRows& layer, const RunRows& above, const EnclosureRule& rule) {
    RunRows hanging;
    subtract(above, grown(layer, rule.corner + rule.row_pitch / 2, rule.row_pitch), hanging);
    return hanging;
}

/// Returns the layer, grown so that it carries all of the layer above. Sharp corners and fins are drawn in as
/// far as the rule allows: the layer grows into them row by row, only as far as needed. Pieces of the layer
/// above that are connected to nothing else are taken over.
RunRows with_thin_of(const RunRows& layer, const RunRows& above, const EnclosureRule& rule) {
    constexpr int longest = 256;  // rows for which a fin is followed
    RunRows hanging = hanging_over(layer, above, rule);
    if (hanging.runs().empty()) return layer;
    const double reach = rule.corner + rule.row_pitch / 2;
    const RunRows about = common(above, grown(hanging, reach, rule.row_pitch));
    RunRows all = layer, out;
    for (int k = 0; k < longest && !hanging.runs().empty(); ++k) {
        unite(all, common(about, grown(all, rule.row_pitch, rule.row_pitch)), out);
        if (out == all) break;
        all = std::move(out);
        hanging = hanging_over(all, above, rule);
    }
    unite(all, common(above, grown(hanging, rule.step, rule.row_pitch)), out);
    return out;
}

/// Replaces a layer. Returns true if it changed.
bool take(LayerStack& layers, std::size_t i, const RunRows& rows) {
    if (rows == layers[i]) return false;
    layers.replace(i, rows);
    return true;
}

bool sweep_down(LayerStack& layers, const EnclosureRule& rule) {
    bool changed = false;
    for (std::size_t i = layers.size(); i-- > 1;) {
        const RunRows& above = layers[i];
        const RunRows below = with_thin_of(with_inside_of(layers[i - 1], above, rule), above, rule);
        changed = take(layers, i - 1, below) || changed;
    }
    return changed;
}

bool sweep_up(LayerStack& layers, const EnclosureRule& rule) {
    bool changed = false;
    for (std::size_t i = 1; i < layers.size(); ++i) {
        changed = take(layers, i, with_inside_of(layers[i], layers[i - 1], rule)) || changed;
    }
    return changed;
}

}  // namespace

int enclose(LayerStack& layers, const EnclosureRule& rule, const CancelToken* cancel) {
    for (int sweeps = 1;; ++sweeps) {
        if (cancel != nullptr && cancel->cancelled()) throw Interrupted("stopped while an enclosure grew");
        const bool down = sweeps % 2 == 1;
        const bool changed = down ? sweep_down(layers, rule) : sweep_up(layers, rule);
        if (!changed && sweeps > 1) return sweeps;
    }
}

}  // namespace lamella
