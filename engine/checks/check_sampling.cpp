// CheckSampling: coarser grids, and conversion of faults back to the full resolution.
#include "engine/checks/check_sampling.h"

#include <algorithm>

namespace lamella {

CheckGrid CheckSampling::subsample(CheckGrid grid) const {
    // The sampled row is the middle of those that it stands for.
    grid.band.across_origin += rows % 2 == 0 ? 0.5 * grid.band.across_pitch : 0;
    grid.band.across_pitch *= rows;
    grid.band.count = (grid.band.count + rows - 1) / rows;
    grid.layer_height *= layers;
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

Fault CheckSampling::to_full_resolution(Fault fault, const CheckGrid& sampled, int layer_count) const {
    fault.layer = sampled_layer(fault.layer);
    fault.at.z = sampled.z0 + (fault.layer + 0.5) * (sampled.layer_height / layers);
    fault.first_layer *= layers;
    fault.end_layer = std::min(fault.end_layer * layers, layer_count);
    std::vector<PlacedRun> all;
    for (const PlacedRun& run : fault.runs) {
        for (int k = 0; k < rows; ++k) all.push_back({fault.layer, run.row * rows + k, run.begin, run.end});
    }
    fault.runs = std::move(all);
    return fault;
}

}  // namespace lamella
