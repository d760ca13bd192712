// StreamingFaults: joins faulty runs of consecutive layers to faults.
#pragma once

#include <utility>
#include <vector>

#include "engine/checks/check_sampling.h"
#include "engine/checks/fault_list.h"
#include "engine/runs/streaming_components.h"

namespace lamella {

/// Joins the faulty rows of a stream of layers to faults across layers. Ignores those whose bounds have a
/// diagonal shorter than `least` mm. Keeps the `most` largest.
class StreamingFaults {
  public:
    StreamingFaults(const CheckGrid& grid, double least, std::size_t most)
        : StreamingFaults(grid, {}, least, most) {}
    /// For subsampled rows and layers.
    StreamingFaults(const CheckGrid& grid, const CheckSampling& sampling, double least, std::size_t most)
        : whole_(grid), grid_(sampling.subsample(grid)), sampling_(sampling), least_(least), faults_(most) {}
    void add(LabelledLayer layer, int index) {
        grid_.weigh(layer, index);
        components_.add(std::move(layer), index, {}, ended_);
        take();
    }
    void add(const RunRows& rows, int index) { add(label_layer(rows, index, Growth{}), index); }
    void finish() {
        components_.finish(ended_);
        take();
    }
    void excuse_greatest() { faults_.excuse_greatest(); }
    /// Ignores faults of less volume (mm^3). Call before the first layer.
    void ignore_below(double volume) { least_volume_ = volume; }
    const FaultList& faults() const { return faults_; }

  private:
    void take() {
        for (const EndedComponent& ended : ended_) {
            Fault fault = grid_.fault(ended.component);
            const dvec3 size = fault.box.size();
            if (size.x * size.x + size.y * size.y + size.z * size.z < least_ * least_) continue;
            fault.size = grid_.volume(ended.component.extent.length);
            if (fault.size < least_volume_) continue;
            faults_.add(sampling_.to_full_resolution(std::move(fault), whole_));
        }
        ended_.clear();
    }
    CheckGrid whole_, grid_;  // grid_ is sampled
    CheckSampling sampling_;
    double least_;
    double least_volume_ = 0;
    StreamingComponents components_;
    std::vector<EndedComponent> ended_;
    FaultList faults_;
};

}  // namespace lamella
