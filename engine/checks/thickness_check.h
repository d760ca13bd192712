// Walls that are too thin and gaps that are too narrow.
#pragma once

#include <optional>

#include "engine/checks/streaming_faults.h"
#include "engine/morphology/thin_feature_search.h"
#include "engine/morphology/thin_features.h"

namespace lamella {

/// Rows to the least thickness that a check looks for. An odd number finds the most: walls of up to four
/// pitches whichever way they run.
inline constexpr double pitches_in_a_thickness = 5;

/// Finds walls thinner, or gaps narrower, than a ball. A limit within the layer is checked layer by layer, in
/// parallel; one across layers is checked against the neighbouring layers, in order.
class ThicknessCheck {
  public:
    /// `thickness` within the layer and `thickness_up` across layers, mm; `most` faults are kept.
    ThicknessCheck(const CheckGrid& grid, int layer_count, double thickness, double thickness_up,
                   FeatureKind medium, std::size_t most);

    /// How far the lattice of cells has to reach, in run units; 0 where layers are compared with their
    /// neighbours.
    double reach() const { return neighbours_ ? 0 : reach_of_cells(measure_); }
    /// The faults of a layer that are known without its neighbours. Pure.
    RunRows prepare(const RunRows& rows, const LayerCells& cells) const;
    /// Takes the next layer and what `prepare` made of it.
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
    int pushed_ = 0;  // layers
    int next_ = 0;    // to be told of, of those looked at
    StreamingFaults found_;
};

}  // namespace lamella
