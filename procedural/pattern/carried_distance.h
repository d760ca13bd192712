// CarriedDistance: numbers of sites, carried along the normals into the space about the surface.
#pragma once

#include <span>
#include <vector>

#include "procedural/texture/surface_sites.h"

namespace lamella {

/// Returns the slope of a number of sites at one of them, at most 1: that of the plane that fits best to its
/// neighbours. The tangents of the sites are needed.
dvec3 slope_at(const SurfaceSites& sites, std::span<const float> distances, std::size_t site);

/// The plane that fits a number best at each site, and the mean of the planes near a point.
class CarriedDistance {
  public:
    /// Sites and distances (mm, by site) have to outlive the object. The tangents of the sites are needed.
    CarriedDistance(const SurfaceSites& sites, std::span<const float> distances);

    /// Returns the distance at a point whose nearest site this is: the mean of what the planes of the site
    /// and its neighbours say, the nearer the more, so that it has no steps where the nearest site changes.
    double at(dvec3 p, std::uint32_t nearest) const;

  private:
    const SurfaceSites& sites_;
    std::span<const float> distances_;
    std::vector<dvec3> slopes_;  ///< by site, within the surface
};

}  // namespace lamella
