// SurfaceCover: points that stand for a body's surface.
#pragma once

#include <vector>

#include "engine/base/cancel_token.h"
#include "engine/field/field.h"
#include "procedural/texture/surface_sites.h"

namespace lamella {

/// Points of a body's surface, each with the area that it stands for. Edges take half a spacing from the
/// faces beside them.
struct SurfaceCover {
    SurfaceSites sites;
    std::vector<double> areas;  ///< mm^2
    dvec3 centroid{0};          ///< of the body, mm
};

/// Samples the surface of a body with about `sites` points. Runs in the caller's arena. Throws InputError for
/// an empty or unbounded body, Interrupted when cancelled.
SurfaceCover cover_surface(const Field& body, std::size_t sites, const CancelToken* cancel);

}  // namespace lamella
