// Walls of less than two struts, whose two sides share one pattern.
#pragma once

#include <span>
#include <vector>

#include "engine/field/field.h"
#include "procedural/texture/surface_sites.h"

namespace lamella {

/// Sets SurfaceSites::across of each site where the body is at most `thickness` mm thick below it.
void set_across(SurfaceSites& sites, const Field& body, double thickness);

/// Returns the sites on thin walls that take the pattern of the other side: of each wall, those of the side
/// with fewer sites. None where a side meets itself, as in a hollow that is closed but for a thin wall.
std::vector<std::uint32_t> back_sites(const SurfaceSites& sites);

/// Replaces the values of sites on thin walls by those across. `values` are by site.
void copy_across(const SurfaceSites& sites, std::span<const std::uint32_t> back, std::vector<float>& values);

/// Makes the pattern solid where the other side of a thin wall is. Each half of a wall takes the pattern of
/// its own side, so a strut of one side alone would be half a wall thick. `values` are by site, above 0 in
/// the solid.
void share_across(const SurfaceSites& sites, std::vector<float>& values);

}  // namespace lamella
