// Distances within a surface, from site to site.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "procedural/texture/surface_sites.h"

namespace lamella {

/// Returns by site the distance (mm) from the border between sites with values above 0 and others: positive
/// where the value is above 0, at most `limit` in magnitude. Between two neighbours of opposite signs the
/// border lies where the line through their values is 0. Distances, good to an eighth of a spacing, are those
/// from the nearest point of the border that a neighbour has, so on a bent surface those far away are a
/// little short.
std::vector<float> signed_distances(const SurfaceSites& sites, std::span<const float> values, double limit);

/// A point of the surface, and a site near it.
struct SitePoint {
    std::uint32_t site = 0;
    dvec3 place{0};  ///< mm
};

/// Points at most one and a half spacings apart: the middle line of a strut.
using SiteLine = std::vector<SitePoint>;

/// Returns by site the distance (mm) from the nearest of the points, at most `limit`.
std::vector<float> distances_from(const SurfaceSites& sites, std::span<const SitePoint> points, double limit);

}  // namespace lamella
