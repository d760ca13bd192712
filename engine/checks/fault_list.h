// FaultList: the worst of many faults, and how many there were.
#pragma once

#include "engine/checks/print_check.h"
#include "engine/runs/streaming_components.h"

namespace lamella {

/// Where the rows and layers of a check lie.
struct CheckGrid {
    RowBand band;             ///< of every layer, a line a row
    double z0 = 0;            ///< lower side of layer 0, mm
    double layer_height = 0;  ///< mm

    double area(std::int64_t length) const {
        return static_cast<double>(length) / run_unit * band.along_pitch * band.across_pitch;
    }
    double volume(std::int64_t length) const { return area(length) * layer_height; }
    double plane(int layer) const { return z0 + (layer + 0.5) * layer_height; }
    Box box(const ComponentExtent& extent) const;
    /// A fault that is a component. Its size is left to the caller.
    Fault fault(const StreamingComponent& component) const;
    /// A fault that lies in one layer.
    Fault fault(const LayerPatch& patch) const;
};

/// Keeps the faults of greatest size; of equals the lowest, then the one of least y and x.
class FaultList {
  public:
    explicit FaultList(std::size_t most) : most_(most) {}

    void add(Fault fault);
    /// Takes the greatest of all out of the list and the count: it is no fault after all.
    void excuse_greatest();
    std::size_t count() const { return count_; }
    /// Fills in what was found.
    void report(CheckResult& result) const;

  private:
    std::size_t most_;
    std::size_t count_ = 0;
    double total_ = 0;
    std::vector<Fault> worst_;  // by falling size, one more than asked for
};

}  // namespace lamella
