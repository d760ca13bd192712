// Subsampling of rows and layers that are finer than a check needs.
#pragma once

#include "engine/checks/fault_list.h"

namespace lamella {

/// One of so many rows and one of so many layers are looked at, about the middle of those that it stands for.
struct CheckSampling {
    int rows = 1, layers = 1;

    /// Where the rows and layers looked at lie.
    CheckGrid subsample(CheckGrid grid) const;
    RunRows subsample(const RunRows& layer) const;
    /// Which layer is looked at of the k-th so many.
    int sampled_layer(int k) const { return k * layers + (layers - 1) / 2; }
    bool samples(int layer) const { return layer == sampled_layer(layer / layers); }
    /// A fault of what was looked at, on that grid, told in terms of all rows and of all layers, of which
    /// there are so many.
    Fault to_full_resolution(Fault fault, const CheckGrid& sampled, int layer_count) const;
};

}  // namespace lamella
