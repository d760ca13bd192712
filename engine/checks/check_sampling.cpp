// CheckSampling: coarser grids, and conversion of faults back to the full resolution.
#include "engine/checks/check_sampling.h"

#include <algorithm>
#include <cmath>

namespace lamella {

CheckGrid CheckSampling::subsample(CheckGrid grid) const {
    // The sampled row is the middle of those that it stands for.
    grid.band.across_origin += rows % 2 == 0 ? 0.5 * grid.band.across_pitch : 0;
    grid.band.across_pitch *= rows;
    grid.band.count = (grid.band.count + rows - 1) / rows;
    if (each_layer(grid.layers)) return grid;
    const double height = grid.layers.equal() ? grid.layers.least_height() * layers : apart;
    grid.layers = {static_cast<int>(std::ceil(grid.layers.total() / height)), height};
    return grid;
}

RunRows CheckSampling::subsample(const RunRows& layer) const {
    if (rows == 1) return layer;
    const auto step = static_cast<std::size_t>(rows);
    RunRows sampled;
    for (std::size_t l = 0; l < layer.lines(); l += step)
        sampled.append_line(layer.line(std::min(l + step / 2, layer.lines() - 1)));
    return sampled;
}

int CheckSampling::samples(const LayerPlan& plan, int layer) const {
    if (each_layer(plan)) return 1;
    if (plan.equal()) return layer == sampled_layer(plan, layer / layers) ? 1 : 0;
    const auto begun = [&](double height) { return static_cast<int>(std::ceil(height / apart - 0.5)); };
    return begun(plan.top(layer)) - begun(plan.bottom(layer));
}

int CheckSampling::sampled_layer(const LayerPlan& plan, int k) const {
    if (each_layer(plan)) return k;
    return plan.equal() ? k * layers + (layers - 1) / 2 : plan.layer_at((k + 0.5) * apart);
}

Fault CheckSampling::to_full_resolution(Fault fault, const CheckGrid& whole) const {
    fault.layer = sampled_layer(whole.layers, fault.layer);
    fault.at.z = whole.plane(fault.layer);
    if (whole.layers.equal()) {
        fault.first_layer *= layers;
        fault.end_layer = std::min(fault.end_layer * layers, whole.layers.count());
    } else {
        fault.first_layer = sampled_layer(whole.layers, fault.first_layer);
        fault.end_layer = sampled_layer(whole.layers, fault.end_layer - 1) + 1;
    }
    std::vector<PlacedRun> all;
    for (const PlacedRun& run : fault.runs) {
        for (int k = 0; k < rows; ++k) all.push_back({fault.layer, run.row * rows + k, run.begin, run.end});
    }
    fault.runs = std::move(all);
    return fault;
}

}  // namespace lamella
