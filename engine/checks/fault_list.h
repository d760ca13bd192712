// FaultList: the worst faults of a kind, and the number of all.
#pragma once

#include "engine/checks/print_check.h"
#include "engine/layers/layer_plan.h"
#include "engine/runs/streaming_components.h"

namespace lamella {

/// The positions of a check's rows and layers.
struct CheckGrid {
    RowBand band;   ///< rows of every layer, one line per row
    double z0 = 0;  ///< lower side of layer 0, mm
    LayerPlan layers;

    /// Returns the area (mm^2) of runs from the sum of their lengths (run units).
    double area(std::int64_t length) const {
        return static_cast<double>(length) / run_unit * band.along_pitch * band.across_pitch;
    }
    /// Returns the volume (mm^3) of runs from the sum of their lengths (run units), weighed where layers
    /// vary.
    double volume(std::int64_t length) const {
        return area(length) * (layers.equal() ? layers.least_height() : unit_height());
    }
    /// Weighs the lengths of a layer's components by its height, for volume(); leaves them where layers are
    /// equal.
    void weigh(LabelledLayer& labelled, int layer) const;
    /// Returns the height of a layer's cutting plane, mm.
    double plane(int layer) const { return z0 + layers.middle(layer); }
    Box box(const ComponentExtent& extent) const;
    /// Makes a fault of a component. The caller sets its size.
    Fault fault(const StreamingComponent& component) const;
    /// Makes a fault of a patch in one layer. The caller sets its size.
    Fault fault(const LayerPatch& patch) const;

  private:
    /// The height that a weight of one stands for, mm: fine enough for a part in two thousand.
    double unit_height() const { return layers.least_height() / 1024; }
};

/// Keeps the `most` largest faults. Of equally large ones it prefers the lowest, then the least y, then the
/// least x.
class FaultList {
  public:
    explicit FaultList(std::size_t most) : most_(most) {}

    void add(Fault fault);
    /// Removes the largest fault from the list and the count: it is no fault after all. The list keeps one
    /// spare fault for this, so call it once at most.
    void excuse_greatest();
    std::size_t count() const { return count_; }
    /// Fills in the number of faults, the sum of their sizes and the largest ones.
    void report(CheckResult& result) const;

  private:
    std::size_t most_;
    std::size_t count_ = 0;
    double total_ = 0;
    std::vector<Fault> worst_;  // by falling size; one more than `most_`, to replace an excused one
};

}  // namespace lamella
