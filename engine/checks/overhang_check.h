// Overhang check: islands, overhangs and long bridges, each layer against the layers below.
#pragma once

#include <deque>
#include <optional>

#include "engine/checks/check_table.h"
#include "engine/checks/hanging_regions.h"
#include "engine/checks/support_hold.h"

namespace lamella {

/// Compares each layer with the layers below it. The first layer lies on the bed.
///
/// An island is a piece of a layer that touches neither the layer below nor a support within the gap that
/// supports keep. A piece that only one row meets is sampled in closer rows first. An island is no fault if
/// it joins what is held before it has the area `PrintLimits::island` and before it is as high as the side of
/// a square of that area, or a layer; until then it holds nothing.
///
/// A region hangs if it stands out over the layer below by more than `overhang` and a pitch. Slopes are
/// followed over several layers, so that a slope is found if its tangent exceeds the limit by a quarter. A
/// hanging region is excused if it is smaller than `free_stretch`, or if in one direction all bridges across
/// it are supported at both ends and no longer than the limit.
class OverhangCheck : public LayerCheck {
  public:
    explicit OverhangCheck(const CheckContext& context);

    std::optional<double> cell_reach() const override { return 0; }
    /// Reads the labels and cells of the layer, and moves its rows and cells away.
    void add(LayerSample& layer, PreparedRows prepared) override;
    void finish() override;
    const FaultList& faults(Check check) const override {
        return check == Check::islands ? islands_ : check == Check::overhangs ? overhangs_ : bridges_;
    }

  private:
    /// A layer below the current one.
    struct Below {
        LayerFootprint rows;
        RunRows hung;                     // regions that hung and were excused, and islands
        std::optional<RowBitmask> inner;  // cells of the part; dropped for older layers if memory is short
    };
    void follow_overhangs(const LayerFootprint& layer, const RowBitmask& outer, const RunRows& islands,
                          Below& next, int index);
    RunRows find_islands(const LayerFootprint& layer, const LabelledLayer& printed, const RowsIn& rows_in,
                         int index);
    std::vector<std::size_t> layers_below(const LabelledLayer& printed,
                                          const std::vector<std::uint8_t>& floats) const;
    RunRows keep_small(const LayerFootprint& layer, const LabelledLayer& printed,
                       const std::vector<std::uint8_t>& floats);
    RunRows too_steep(const LayerFootprint& layer, const RowBitmask& outer, const RunRows& hangs,
                      int index) const;
    RunRows judge_regions(const LayerFootprint& layer, const RunRows& hanging, int index);
    RunRows standing_out(const LayerFootprint& layer, const RunRows& found, int index) const;
    void add_overhang(const RunRows& rows, int index);
    /// Returns how far a layer may stand out over the one that lies so many layers below it, pitches.
    double allowance(int index, std::size_t layers_below) const;

    CheckGrid grid_;
    PrintLimits limits_;
    bool follows_overhangs_;       // false: looks for islands only
    std::size_t slope_layers_;     // number of layers over which a slope is followed
    std::size_t support_layers_;   // number of layers below whose supports may carry an island
    std::deque<Below> below_;      // newest last
    std::size_t unheld_layers_;    // number of layers that an island may have and be no fault
    std::vector<RunRows> unheld_;  // such islands of the layer below, by the layers that they have below it
    SupportHold supports_;
    StreamingComponents hanging_;
    std::vector<EndedComponent> ended_;
    FaultList islands_, overhangs_, bridges_;
};

}  // namespace lamella
