// CheckSampling: subsampling of rows and layers that are finer than a check needs.
#pragma once

#include "engine/checks/fault_list.h"

namespace lamella {

/// Takes one of `rows` rows and one of `layers` equal layers. A sampled row or layer is about the middle of
/// those that it stands for. Layers that vary are sampled at equal distances: a high one several times.
struct CheckSampling {
    int rows = 1, layers = 1;
    double apart = 0;  ///< distance of samples where layers vary, mm; 0: each layer is one

    /// Returns the grid of the sampled rows and layers.
    CheckGrid subsample(CheckGrid grid) const;
    /// Returns the sampled rows of a layer.
    RunRows subsample(const RunRows& layer) const;
    /// Returns how many samples are taken of a layer.
    int samples(const LayerPlan& plan, int layer) const;
    /// Converts a fault found on the sampled grid to all rows and layers of the whole one.
    Fault to_full_resolution(Fault fault, const CheckGrid& whole) const;

  private:
    bool each_layer(const LayerPlan& plan) const { return plan.equal() ? layers == 1 : apart == 0; }
    /// Returns the layer of sample number k.
    int sampled_layer(const LayerPlan& plan, int k) const;
};

}  // namespace lamella
