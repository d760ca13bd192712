// The surface of the shape that densities describe, as a closed mesh with exact distances.
#pragma once

#include "engine/mesh/mesh.h"
#include "procedural/optimization/density_shape.h"

namespace lamella {

/// Returns the surface where the densities of a grid that fills `box` cross `level`, by marching tetrahedra
/// (Doi and Koide 1991) over elements divided into `parts` along each axis; mm. The surface is closed: the
/// outermost densities go on beyond the box for more than a quarter of an element, as far as a body may stand
/// out from its grid, and end there. A grid of one layer is not divided along z. No triangles if no density
/// is above the level.
TriangleMesh density_surface(const DensityGrid& grid, const Box& box, double level, int parts);

}  // namespace lamella
