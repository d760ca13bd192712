// Struts below the places where a pattern would begin in the air, when it is printed upward.
#pragma once

#include <span>
#include <vector>

#include "procedural/pattern/sound_pattern.h"

namespace lamella {

/// Returns the middle lines of struts, down the surface to the solid below: from each place where the solid
/// of a skin `depth` mm thick begins, unless it meets solid that began lower within a spacing of height, on a
/// roof within its thickness as well.
/// Where nothing of the surface is lower, there is no strut: only supports can hold that. Struts returned
/// together begin at least `apart` mm from each other.
std::vector<SiteLine> struts_below(const SurfaceSites& sites, std::span<const float> distances, double depth,
                                   double apart);

/// Asks another choice, which may be null, until it has no more bridges, and then chooses struts_below().
class StrutsBelow : public BridgeChoice {
  public:
    /// Sites and the other choice have to outlive the object.
    StrutsBelow(const SurfaceSites& sites, double depth, double apart, BridgeChoice* other)
        : sites_(sites), depth_(depth), apart_(apart), other_(other) {}
    std::vector<SiteLine> choose(std::span<const float> distances) override;
    double weakness() const override { return other_ != nullptr ? other_->weakness() : 0; }

  private:
    const SurfaceSites& sites_;
    double depth_, apart_;
    BridgeChoice* other_;  ///< null once it is done
};

}  // namespace lamella
