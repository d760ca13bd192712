// BridgesByForces: bridges where loads would use them most.
#pragma once

#include "procedural/pattern/gap_crossings.h"
#include "procedural/pattern/pattern_bridges.h"
#include "procedural/pattern/skin_loads.h"
#include "procedural/pattern/sound_pattern.h"

namespace lamella {

struct ForceSettings {
    BridgeSettings by_shape{};
    double thickness = 1;  ///< of the skin, mm
};

/// Returns by how much a bar between two points lowers the compliance of a body: exact (Sherman and Morrison
/// 1950). `stretch` is how far the load moves the points apart without it, `flexibility` how far a unit force
/// along it does.
inline double gain_of_bar(double stiffness, double stretch, double flexibility) {
    return stiffness * stretch * stretch / (1 + stiffness * flexibility);
}

/// Chooses bridges by shape until there are none left, or four times, and then from a finite element analysis
/// of the skin. Of the crossings of gaps, the ends of those that would carry most as bars move apart, or
/// together, most: a bar's gain is at most its stiffness times the square of that. Of the best, the
/// flexibility between their ends is solved for as well, and they are taken by gain for their length. None
/// are chosen once the compliance is three times that of the closed skin, the solid has grown by a twentieth,
/// or two rounds have gained less than 2 %.
class BridgesByForces : public BridgeChoice {
  public:
    /// Sites, elements and loads have to outlive the object.
    BridgesByForces(const SurfaceSites& sites, const SkinElements& elements, const SkinLoads& loads,
                    const ForceSettings& settings);

    /// Throws InputError as the loads do, Interrupted when cancelled.
    std::vector<SiteLine> choose(std::span<const float> distances) override;
    double weakness() const override { return softness_.empty() ? infinity : softness_.back(); }
    /// The mean over the load cases of the compliance, over that of the closed skin, by analysis.
    const std::vector<double>& softness() const { return softness_; }

  private:
    struct Analysis;
    /// A bridge as a bar between two elements.
    struct Bar {
        const GapCrossing* crossing;
        std::uint32_t from, to;  ///< cubes of the elements
        dvec3 way;               ///< unit vector
        double stiffness = 0;    ///< in units of the elements
        double score = 0;        ///< gain for its length
    };
    std::vector<Bar> possible_bars(const GapCrossings& gaps, const Analysis& analysis) const;
    bool has_stalled() const;
    void solve_best(Analysis& analysis, std::vector<Bar>& bars) const;

    const SurfaceSites& sites_;
    const SkinElements& elements_;
    const SkinLoads& loads_;
    ForceSettings settings_;
    std::vector<double> closed_;  ///< compliances of the closed skin, by case
    std::vector<double> softness_;
    std::size_t solid_at_first_ = 0;  ///< sites
    int rounds_by_shape_ = 0;
};

}  // namespace lamella
