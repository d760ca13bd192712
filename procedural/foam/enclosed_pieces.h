// Finds pieces of the body that are enclosed in one Voronoi cell, so that no face or edge of the foam meets
// them.
#pragma once

#include <span>
#include <vector>

#include "procedural/foam/cell_faces.h"
#include "procedural/foam/surface_curves.h"

namespace lamella {

/// Returns lines that represent such pieces in a cell: for each piece, the lines from its deepest point along
/// the six axes to its surface. `curves` are the curves on the cell's faces; pieces around them are not
/// enclosed. Pieces smaller than 1/16 of the cell (1/8 if curves cross its faces) are missed, and pieces
/// closer together than that count as one. `own` and `sites` are those of the cell, in seed space.
std::vector<SurfaceCurve> enclosed_pieces(std::span<const CellFaces::Face> faces,
                                          std::span<const SurfaceCurve> curves, const SurfaceTracer& tracer,
                                          const Seed& own, std::span<const Seed> sites,
                                          const Stretch& stretch);

}  // namespace lamella
