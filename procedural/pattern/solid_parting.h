// SolidParting: whether a pattern falls apart where a strut is cut, and how long the ways through it are.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "procedural/pattern/site_distance.h"

namespace lamella {

/// Floods of the solid, sites with values above 0, from both sides of a cut. One object serves many cuts, one
/// after the other.
class SolidParting {
  public:
    /// Sites and values have to outlive the object.
    SolidParting(const SurfaceSites& sites, std::span<const float> values);

    /// Cuts a strut along a line from one of its sides to the other. Returns the size of the smaller part, in
    /// sites; 0 if the solid stays whole. Both sides are flooded in turns, until one ends or both meet.
    std::size_t cut(std::span<const SitePoint> line);

    /// After a cut that parts the solid: whether a site is in the smaller part.
    bool in_smaller(std::uint32_t site) const { return stamp_[site] == now_ && part_[site] == smaller_; }
    /// The number of steps from the cut to a site; `most` for a site that was not reached in as many.
    std::uint32_t steps(std::uint32_t site, std::uint32_t most) const {
        return stamp_[site] == now_ ? std::min(steps_[site], most) : most;
    }

  private:
    void begin(std::span<const SitePoint> line);
    bool advance(int part);
    bool mark(std::uint32_t site, int part, std::uint32_t steps);

    const SurfaceSites& sites_;
    std::span<const float> values_;
    std::vector<std::uint32_t> stamp_, steps_;
    std::vector<std::uint8_t> part_;
    std::uint32_t now_ = 0;
    struct Front {
        std::vector<std::uint32_t> sites;  ///< in the order in which they were reached
        std::size_t done = 0;              ///< of them, whose neighbours were looked at
    };
    std::vector<Front> fronts_;
    bool met_ = false;
    int smaller_ = 1;
};

/// The length of the shortest ways through the solid, along neighbours.
class SolidWays {
  public:
    /// Sites and values have to outlive the object.
    SolidWays(const SurfaceSites& sites, std::span<const float> values);

    /// Returns the length (mm) of the way between two solid sites; `limit` if it is not shorter.
    double length(std::uint32_t from, std::uint32_t to, double limit);

  private:
    const SurfaceSites& sites_;
    std::span<const float> values_;
    std::vector<std::uint32_t> stamp_;
    std::vector<double> length_;
    std::uint32_t now_ = 0;
};

}  // namespace lamella
