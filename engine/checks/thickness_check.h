// ThicknessCheck: finds walls that are too thin or gaps that are too narrow.
#pragma once

#include <optional>

#include "engine/checks/check_table.h"
#include "engine/checks/streaming_faults.h"
#include "engine/morphology/thin_feature_search.h"
#include "engine/morphology/thin_features.h"

namespace lamella {

/// The number of row pitches in the least thickness that a check looks for. An odd number finds most: a ball
/// of an even number of pitches between rows just misses the next row. With five, every wall of up to 3.4
/// pitches is found in any direction, and of up to four along the rows.
inline constexpr double pitches_in_a_thickness = 5;

/// Finds walls thinner, or gaps narrower, than a ball. A limit within the layer is checked layer by layer, in
/// parallel; one across layers is checked against the neighbouring layers, in order.
class ThicknessCheck : public LayerCheck {
  public:
    /// `kind` says whether walls or gaps are measured, and so which limits hold.
    ThicknessCheck(const CheckContext& context, FeatureKind kind);

    /// Returns how far the layer's cells are dilated, run units; 0 if layers are compared with their
    /// neighbours.
    std::optional<double> cell_reach() const override { return neighbours_ ? 0 : reach_of_cells(measure_); }
    /// Finds the faults of a layer that are known without its neighbours.
    PreparedRows prepare(const LayerSample& layer) const override;
    bool accepts(const PreparedRows& prepared, std::size_t lines) const override;
    void add(LayerSample& layer, PreparedRows prepared) override;
    void finish() override;
    const FaultList& faults(Check /*check*/) const override { return found_.faults(); }

  private:
    void take();

    ThicknessCheck(const CheckContext& context, FeatureKind kind, double thickness, double thickness_up);

    FeatureKind kind_;
    CheckSampling sampling_;
    LayerPlan layers_;
    Thinness measure_;
    double row_pitch_ = 0;
    std::optional<ThinFeatureSearch> neighbours_;
    int next_ = 0;  // number of the next sampled layer to report
    StreamingFaults found_;
};

}  // namespace lamella
