// Overhang check: islands, overhangs and long bridges, each layer against the layers below.
#pragma once

#include <deque>
#include <functional>
#include <optional>

#include "engine/checks/hanging_regions.h"
#include "engine/checks/support_hold.h"
#include "engine/morphology/row_bitmask.h"

namespace lamella {

/// The rows of a layer, as far as the next ones are compared with them.
struct LayerFootprint {
    RunRows part;
    RunRows supports;            ///< empty rows where there are none
    RunRows part_with_supports;  ///< nothing where there are none

    const RunRows& printed() const { return supports.runs().empty() ? part : part_with_supports; }
};

/// What a layer prints, in the rows of any band.
using RowsIn = std::function<RunRows(const RowBand&)>;

/// Compares each layer with those below it; the first one lies on the bed.
///
/// An island is a piece of a layer that touches nothing of the layer below, nor a support within the gap that
/// supports keep; one that a single row sees is looked at in closer rows first. A region hangs where it
/// stands out by more than `overhang` and a pitch over the layer below; slopes are followed over several
/// layers, so that one is found that is steeper by a quarter than what is allowed (its tangent). What hangs
/// is excused where it is smaller than `free_stretch`, or where one direction leads everywhere from hold to
/// hold within the length of a bridge.
class OverhangCheck {
  public:
    OverhangCheck(const CheckGrid& grid, const PrintLimits& limits, std::size_t most);

    /// `cells` are those of the part, on one lattice for all layers; `printed` is what the layer prints,
    /// labelled without growth, and `rows_in` that in other bands.
    void add(LayerFootprint layer, LayerCells cells, const LabelledLayer& printed, const RowsIn& rows_in,
             int index);
    void finish();

    const FaultList& islands() const { return islands_; }
    const FaultList& overhangs() const { return overhangs_; }
    const FaultList& bridges() const { return bridges_; }

  private:
    /// A layer below and what hung in it and may, or is told of as an island.
    struct Below {
        LayerFootprint rows;
        RunRows hung;
        std::optional<RowBitmask> inner;  // by the part; of older layers only where there is memory to spare
    };
    void follow_overhangs(const LayerFootprint& layer, const RowBitmask& outer, const RunRows& islands,
                          Below& next, int index);
    RunRows find_islands(const LayerFootprint& layer, const LabelledLayer& printed, const RowsIn& rows_in,
                         int index);
    RunRows too_steep(const LayerFootprint& layer, const RowBitmask& outer, const RunRows& hangs) const;
    RunRows judge_regions(const LayerFootprint& layer, const RunRows& hanging, int index);
    RunRows standing_out(const LayerFootprint& layer, const RunRows& found) const;
    void add_overhang(const RunRows& rows, int index);

    CheckGrid grid_;
    PrintLimits limits_;
    bool follows_overhangs_;      // or nothing but islands
    double step_;                 // by which a layer may stand out, pitches
    std::size_t slope_layers_;    // over which a slope is followed
    std::size_t support_layers_;  // back, whose supports an island may stand on
    std::deque<Below> below_;     // newest last
    SupportHold supports_;
    StreamingComponents hanging_;
    std::vector<EndedComponent> ended_;
    FaultList islands_, overhangs_, bridges_;
};

}  // namespace lamella
