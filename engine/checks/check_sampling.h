// CheckSampling: subsampling of rows and layers that are finer than a check needs.
#pragma once

#include "engine/checks/fault_list.h"

namespace lamella {

/// Takes one of `rows` rows and one of `layers` layers. A sampled row or layer is about the middle of those
/// that it stands for.
struct CheckSampling {
    int rows = 1, layers = 1;

    /// Returns the grid of the sampled rows and layers.
    CheckGrid subsample(CheckGrid grid) const;
    /// Returns the sampled rows of a layer.
    RunRows subsample(const RunRows& layer) const;
    /// Returns the index of the sampled layer number k.
    int sampled_layer(int k) const { return k * layers + (layers - 1) / 2; }
    bool samples(int layer) const { return layer == sampled_layer(layer / layers); }
    /// Converts a fault found on the sampled grid to all rows and all `layer_count` layers.
    Fault to_full_resolution(Fault fault, const CheckGrid& sampled, int layer_count) const;
};

}  // namespace lamella
