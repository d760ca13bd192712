// Crumbs of a pattern in the space below the surface.
#pragma once

#include "engine/field/field.h"
#include "procedural/pattern/surface_pattern.h"

namespace lamella {

/// Makes pieces of the pattern void that have less than `least` samples, over the faces of samples between
/// the surface and `depth` mm below it. On the surface a pattern is one piece; below it, where the nearest
/// points of the surface change abruptly, crumbs may be cut off. Samples outside the skin stay where the
/// next one towards it does, so that none reaches into the skin alone. Returns how many pieces were dropped.
std::size_t drop_crumbs(const Field& body, double depth, std::size_t least, SurfaceBricks& bricks);

}  // namespace lamella
