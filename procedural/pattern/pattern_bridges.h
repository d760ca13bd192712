// Bridges that make a pattern sound by its shape alone: no strut whose loss parts it, no long detours.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/cancel_token.h"
#include "procedural/pattern/gap_crossings.h"
#include "procedural/pattern/sound_pattern.h"

namespace lamella {

struct BridgeSettings {
    double strut = 0.8;        ///< width of a bridge, mm
    double detour = 8;         ///< longest way from side to side of a gap, over the width of gap and strut
    double widest_gap = 6;     ///< that is bridged to shorten a detour, in struts
    double widest_strut = 3;   ///< that counts as one that may break, in struts
    double least_part = 0.02;  ///< of the solid; what a strut holds that is less is an ornament
    double apart = 4;          ///< least distance of bridges that are chosen together, mm
    const CancelToken* cancel = nullptr;  ///< may be null
};

/// What is unsound, and the bridges that mend it.
struct BridgePlan {
    std::vector<SiteLine> bridges;
    std::size_t cut_struts = 0;  ///< places where one strut alone holds a part
    std::size_t detours = 0;     ///< gaps round which the way is too long
};

/// Chooses bridges for a pattern, given by its distances (mm, positive in the solid). Struts that alone hold
/// a part of the solid come first: such a part gets a second hold, where the way round is longest for the
/// bridge's length. Then come detours, the longest for the bridge's length first. Bridges chosen together
/// lie apart, so some of what is unsound may be left for another plan.
BridgePlan plan_bridges(const SurfaceSites& sites, std::span<const float> distances,
                        const BridgeSettings& settings);

/// Chooses bridges by plan_bridges().
class BridgesByShape : public BridgeChoice {
  public:
    /// The sites have to outlive the object.
    BridgesByShape(const SurfaceSites& sites, const BridgeSettings& settings)
        : sites_(sites), settings_(settings) {}
    std::vector<SiteLine> choose(std::span<const float> distances) override {
        last_ = plan_bridges(sites_, distances, settings_);
        return last_.bridges;
    }
    /// What was found the last time.
    const BridgePlan& last() const { return last_; }

  private:
    const SurfaceSites& sites_;
    BridgeSettings settings_;
    BridgePlan last_;
};

}  // namespace lamella
