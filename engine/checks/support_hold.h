// Tracks which regions of a layer the supports below carry.
#pragma once

#include <vector>

#include "engine/checks/fault_list.h"
#include "engine/morphology/weighted_rows.h"

namespace lamella {

/// Follows supports upward: a place is held where it lies within `spacing` of a support, at its height or
/// above, as the overhang survey places them. Memory: the last layer's supports, and of the layers within
/// that distance the places where supports end.
class SupportHold {
  public:
    /// Lengths in mm; `gap` is the height that may lie between a support and what it holds.
    SupportHold(const CheckGrid& grid, double spacing, double gap);

    /// What of these rows of the next layer the supports so far do not hold. Quick where that is little, or
    /// where they are held from near.
    RunRows unheld(const RunRows& rows) const;
    /// The supports of the next layer.
    void add(const RunRows& supports);

  private:
    /// A run of a layer that the next one has not.
    struct Top {
        Run run;
        std::size_t layer;
    };
    /// Whether nothing is left of supports that might hold anything.
    bool empty() const;
    /// The square of the reach of what ends so many layers down, run units^2.
    double weight(std::size_t layers_down) const;
    /// Tells take(run) what a row holds of a run `about` on a line so many rows away.
    template <typename Take>
    void for_held_by_row(std::size_t row, std::size_t rows_away, const Run& about, Take take) const;

    double spacing_, gap_;                // mm
    double layer_height_, unit_;          // mm; a run unit
    std::size_t layers_up_;               // over its end to which a support may hold something
    std::vector<RoundedExtent> reaches_;  // of what goes on, so many rows away
    RunRows last_;                        // of the last layer
    std::vector<std::vector<Top>> tops_;  // by row, the oldest first
    std::size_t layers_ = 0;              // added
};

}  // namespace lamella
