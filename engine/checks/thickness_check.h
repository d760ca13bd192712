// ThicknessCheck: finds walls that are too thin or gaps that are too narrow.
#pragma once

#include <optional>

#include "engine/checks/streaming_faults.h"
#include "engine/morphology/thin_feature_search.h"
#include "engine/morphology/thin_features.h"

namespace lamella {

/// The number of row pitches in the least thickness that a check looks for. An odd number finds most: with
/// five, every wall of up to four pitches, in any direction.
inline constexpr double pitches_in_a_thickness = 5;

/// Finds walls thinner, or gaps narrower, than a ball. A limit within the layer is checked layer by layer, in
/// parallel; one across layers is checked against the neighbouring layers, in order.
class ThicknessCheck {
  public:
    /// `thickness` within the layer and `thickness_up` across layers, mm; `most` faults are kept.
    ThicknessCheck(const CheckGrid& grid, int layer_count, double thickness, double thickness_up,
                   FeatureKind medium, std::size_t most);

    /// Returns how far beyond the rows the cells passed to prepare() must extend, run units. 0 if the check
    /// is across layers.
    double reach() const { return neighbours_ ? 0 : reach_of_cells(measure_); }
    /// Finds the faulty points of a layer within the layer; none if the check is across layers. Pure, for use
    /// in parallel.
    RunRows prepare(const RunRows& rows, const LayerCells& cells) const;
    /// Adds the next layer and the result of prepare() for it.
    void add(const RunRows& rows, const RunRows& prepared);
    void finish();
    const FaultList& faults() const { return found_.faults(); }

  private:
    void take();

    FeatureKind medium_;
    CheckSampling sampling_;
    Thinness measure_;
    double row_pitch_ = 0;
    std::optional<ThinFeatureSearch> neighbours_;
    int pushed_ = 0;  // number of layers
    int next_ = 0;    // number of the next sampled layer to report
    StreamingFaults found_;
};

}  // namespace lamella
