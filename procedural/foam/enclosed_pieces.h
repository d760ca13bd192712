// Pieces of the body that lie within one Voronoi cell, so that no face or edge of the foam meets them.
#pragma once

#include <span>
#include <vector>

#include "procedural/foam/cell_faces.h"
#include "procedural/foam/surface_curves.h"

namespace lamella {

/// The lines that stand for such pieces of a cell: from the deepest point of each along the six axes to its
/// surface. `curves` are those on the cell's faces: what lies about them is no such piece. What is smaller
/// than 1/16 of the cell, or 1/8 of one that the surface crosses, is not seen, and pieces nearer to each
/// other than that count as one. `own` and `sites` are the cell's, in the seeds' space.
std::vector<SurfaceCurve> enclosed_pieces(std::span<const CellFaces::Face> faces,
                                          std::span<const SurfaceCurve> curves, const SurfaceTracer& tracer,
                                          const Seed& own, std::span<const Seed> sites,
                                          const Stretch& stretch);

}  // namespace lamella
