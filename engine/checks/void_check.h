// VoidCheck: finds cavities and suction cups in the void of a solid that is printed layer by layer.
#pragma once

#include "engine/checks/check_table.h"

namespace lamella {

/// Follows the connected components of the void from layer to layer. Runs of void that overlap or touch, in
/// neighbouring rows and layers, corners included, are connected. A component that reaches the border of the
/// rows is outside.
///
/// A cavity is a component without a way out, once the part is off its bed. A cup is a component that was
/// closed off while its layers were printed, between the bed, the part and the film or blade at the layer's
/// plane, and that opens later, upward or to the bed.
class VoidCheck : public LayerCheck {
  public:
    explicit VoidCheck(const CheckContext& context)
        : grid_(context.grid),
          min_cavity_(context.limits.cavity),
          min_cup_(context.limits.cup),
          cavities_(context.max_faults),
          cups_(context.max_faults) {}

    /// Labels the void of the layer; its first row is outside.
    PreparedRows prepare(const LayerSample& layer) const override;
    bool accepts(const PreparedRows& prepared, std::size_t lines) const override;
    void add(LayerSample& layer, PreparedRows prepared) override;
    void finish() override;
    const FaultList& faults(Check check) const override { return check == Check::cups ? cups_ : cavities_; }

  private:
    void judge(const EndedComponent& ended, bool at_the_top);

    CheckGrid grid_;
    double min_cavity_, min_cup_;  // mm^3
    StreamingComponents voids_;
    std::vector<EndedComponent> ended_;
    FaultList cavities_, cups_;
};

}  // namespace lamella
