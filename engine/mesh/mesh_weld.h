// Joining the corners along open borders that were meant to be one.
#pragma once

#include <cstddef>

#include "engine/mesh/mesh.h"

namespace lamella {

struct BorderWeld {
    std::size_t joined = 0;  ///< corners that were given up for a neighbour
    double farthest = 0.0;   ///< the largest distance bridged, mm
};

/// Joins vertices of open edges that lie closer together than 1e-6 of the bounding box's diagonal, then 1e-5,
/// then 1e-4; a step is kept only where it leaves fewer open edges. From the second step on no corner moves
/// by more than a tenth of its shortest edge, so detail does not collapse. Triangles that shrink to a line
/// are removed.
BorderWeld weld_borders(TriangleMesh& mesh);

}  // namespace lamella
