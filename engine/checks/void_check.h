// What becomes of the void while a solid is printed layer by layer: cavities, and suction cups.
#pragma once

#include "engine/checks/fault_list.h"

namespace lamella {

/// Follows the void of layers. Runs of it that overlap or touch, in neighbouring rows and layers, corners
/// included, are one; what reaches the border of the rows is outside.
///
/// A cavity is void that no way leads out of, once the part is off its bed. A cup is void that was closed off
/// while its layers were printed, between the bed, the part and the film or blade at the layer's plane, and
/// opens later, upward or to the bed.
class VoidCheck {
  public:
    /// Volumes, mm^3, from which each matters; how many faults of each are kept.
    VoidCheck(const CheckGrid& grid, double min_cavity, double min_cup, std::size_t most)
        : grid_(grid), min_cavity_(min_cavity), min_cup_(min_cup), cavities_(most), cups_(most) {}

    /// The void of a layer, labelled; its first row is outside. Pure.
    static LabelledLayer label(const RunRows& solid, const CheckGrid& grid, int layer);
    void add(LabelledLayer voids, int layer);
    void finish();

    const FaultList& cavities() const { return cavities_; }
    const FaultList& cups() const { return cups_; }

  private:
    void judge(const EndedComponent& ended, bool at_the_top);

    CheckGrid grid_;
    double min_cavity_, min_cup_;
    StreamingComponents voids_;
    std::vector<EndedComponent> ended_;
    FaultList cavities_, cups_;
};

}  // namespace lamella
