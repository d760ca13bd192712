// VoidCheck: finds cavities and suction cups in the void of a solid that is printed layer by layer.
#pragma once

#include "engine/checks/fault_list.h"

namespace lamella {

/// Follows the connected components of the void from layer to layer. Runs of void that overlap or touch, in
/// neighbouring rows and layers, corners included, are connected. A component that reaches the border of the
/// rows is outside.
///
/// A cavity is a component without a way out, once the part is off its bed. A cup is a component that was
/// closed off while its layers were printed, between the bed, the part and the film or blade at the layer's
/// plane, and that opens later, upward or to the bed.
class VoidCheck {
  public:
    /// `min_cavity`, `min_cup`: least volumes that are faults, mm^3. `most` faults of each kind are kept.
    VoidCheck(const CheckGrid& grid, double min_cavity, double min_cup, std::size_t most)
        : grid_(grid), min_cavity_(min_cavity), min_cup_(min_cup), cavities_(most), cups_(most) {}

    /// Returns the labelled void of a layer. `solid` has nothing in its first row, which is outside. Pure.
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
