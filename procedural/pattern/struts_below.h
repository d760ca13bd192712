// Struts below the places where a pattern would begin in the air, when it is printed upward.
#pragma once

#include <span>
#include <vector>

#include "procedural/pattern/hanging_pieces.h"
#include "procedural/pattern/sound_pattern.h"

namespace lamella {

/// Returns the middle lines of struts, down through the skin to the solid below, from the pieces that hang.
/// Where nothing of the skin is lower, there is no strut: only supports can hold that. Struts returned
/// together begin at least `apart` mm from each other.
std::vector<SiteLine> struts_below(const SurfaceSites& sites, const HangingPieces& pieces,
                                   std::span<const float> distances, double apart);

/// Asks another choice, which may be null, until it has no more bridges, at most five times, and then chooses
/// struts below the pieces of the pattern that hang.
class StrutsBelow : public BridgeChoice {
  public:
    /// Sites and the other choice have to outlive the object.
    StrutsBelow(const SurfaceSites& sites, const Field& body, double depth, double apart, BridgeChoice* other)
        : sites_(sites), pieces_(sites, body, depth), apart_(apart), other_(other) {}
    std::vector<SiteLine> choose(std::span<const float> distances) override;
    /// Returns struts below what hangs, whatever the other choice wants.
    std::vector<SiteLine> missing(std::span<const float> distances) const {
        return struts_below(sites_, pieces_, distances, apart_);
    }
    /// Adds struts below what hangs to a pattern's distances, until none is missing, in at most 32 rounds.
    /// Struts are `strut` mm wide; distances are told up to `limit` mm. Returns how many it added.
    std::size_t complete(double strut, double limit, std::vector<float>& distances) const;
    double weakness() const override { return other_ != nullptr ? other_->weakness() : 0; }

  private:
    const SurfaceSites& sites_;
    HangingPieces pieces_;
    double apart_;
    BridgeChoice* other_;  ///< null once it is done
    int asked_ = 0;        ///< how often
};

}  // namespace lamella
