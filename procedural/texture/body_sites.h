// Sites on the surface of a body, and the directions of a pattern on them.
#pragma once

#include <optional>

#include "engine/base/cancel_token.h"
#include "engine/field/field.h"
#include "procedural/texture/surface_sites.h"

namespace lamella {

/// Returns the sites of a body's surface: of a lattice of cubes of `spacing` mm, the feet of the middles that
/// lie in their own cube; one to two for a square of the spacing. Neighbours are in cubes that share a face
/// or an edge, at most two spacings away, and not back to back, as the two sides of a thin wall are. Tangents
/// are not set. For bodies whose value is a distance near their surface. Throws InputError for an empty or
/// unbounded body, and for more than `most` sites.
SurfaceSites sites_on_surface(const Field& body, double spacing, std::size_t most, const CancelToken* cancel);

/// Sets the tangents. With an axis, the pattern's y points along it, as far as the surface lets it; otherwise
/// they are smooth by themselves: each becomes the mean of its neighbours', in `sweeps` sweeps, from those of
/// the nearest sites of a coarser grid, or from any.
void set_tangents(SurfaceSites& sites, const SurfaceSites* coarser, std::optional<dvec3> axis, int sweeps);

}  // namespace lamella
