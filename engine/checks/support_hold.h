// SupportHold: tracks which regions of a layer the supports below carry.
#pragma once

#include <vector>

#include "engine/checks/fault_list.h"
#include "engine/morphology/weighted_rows.h"

namespace lamella {

/// Follows supports upward. A point is supported if it lies within `spacing` of a support, at the support's
/// height or above; the overhang survey places supports by the same rule. Memory: the last layer's supports,
/// and the upper ends of supports in the layers within that distance.
class SupportHold {
  public:
    /// Lengths in mm. `gap` is the height that may lie between a support and the part it carries.
    SupportHold(const CheckGrid& grid, double spacing, double gap);

    /// Returns the parts of `rows`, of the next layer, that no support added so far carries. Quick if few
    /// rows are given, or if supports are near.
    RunRows unheld(const RunRows& rows) const;
    /// Adds the supports of the next layer.
    void add(const RunRows& supports);

  private:
    /// An upper end of supports: a run of `layer` that the next layer does not have.
    struct Top {
        Run run;
        std::size_t layer;
    };
    /// Returns true if no support within reach is left.
    bool empty() const;
    /// Returns the squared reach, within a layer, of a support that ends with layer `top` - 1; run units^2,
    /// negative if there is none.
    double weight(std::size_t top, std::size_t layer) const;
    /// Calls take(run) with the intervals that the supports of `row` carry, on a line `rows_away` from it,
    /// near the run `about`.
    template <typename Take>
    void for_held_by_row(std::size_t row, std::size_t rows_away, const Run& about, Take take) const;

    double spacing_, gap_;  // mm
    LayerPlan plan_;
    double unit_;                         // length of a run unit, mm
    std::size_t layers_up_;               // number of layers above its end that a support may carry
    std::vector<RoundedExtent> reaches_;  // reach of supports in the last layer, by rows away
    RunRows last_;                        // supports of the last layer
    std::vector<std::vector<Top>> tops_;  // by row, the oldest first
    std::size_t layers_ = 0;              // number of layers added
};

}  // namespace lamella
