// GapCrossings: where a gap of a pattern could be bridged.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "procedural/pattern/site_distance.h"

namespace lamella {

/// A straight way over a gap, through a point of its medial axis, between the two sites nearest to it.
struct GapCrossing {
    std::uint32_t from = 0, to = 0;                ///< solid sites beside the gap
    std::uint32_t middle_from = 0, middle_to = 0;  ///< neighbours in the gap, nearest to either
    double width = 0;                              ///< from `from` to `to`, mm
};

/// The crossings of all gaps: sites with values not above 0. With the signs changed, those of struts.
class GapCrossings {
  public:
    /// The sites have to outlive the object.
    GapCrossings(const SurfaceSites& sites, std::span<const float> values);

    /// In the order of middle_from, then middle_to.
    const std::vector<GapCrossing>& all() const { return crossings_; }
    /// Returns the points along a crossing, both ends among them.
    SiteLine line(const GapCrossing& crossing) const;

  private:
    void hand_on_owners(std::span<const float> values);
    void find_crossings();

    const SurfaceSites& sites_;
    std::vector<std::uint32_t> owner_;   ///< by site of a gap the nearest solid site
    std::vector<std::uint32_t> before_;  ///< by site of a gap the neighbour on the way to its owner
    std::vector<GapCrossing> crossings_;
};

/// Returns the points of a line of neighbours, moved sideways within the surface onto the straight way from
/// its first to its last site.
SiteLine straightened(const SurfaceSites& sites, std::span<const std::uint32_t> line);

/// Chooses sites that are at least so far apart: those asked for first.
class SitesApart {
  public:
    /// The sites have to outlive the object.
    SitesApart(const SurfaceSites& sites, double distance);
    bool is_free(std::uint32_t site) const { return blocked_[site] == 0; }
    /// Takes a site, and blocks those that are nearer to it than the distance.
    void take(std::uint32_t site);

  private:
    const SurfaceSites& sites_;
    double square_;  ///< of the distance
    std::vector<std::uint8_t> blocked_;
    std::vector<std::uint32_t> open_;
};

}  // namespace lamella
