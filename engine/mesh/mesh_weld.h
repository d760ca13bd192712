// Welding of nearly coincident vertices along open borders.
#pragma once

#include <cstddef>

#include "engine/mesh/mesh.h"

namespace lamella {

struct BorderWeld {
    std::size_t joined = 0;  ///< vertices that were merged into a neighbour
    double farthest = 0.0;   ///< the largest distance bridged, mm
};

/// Joins vertices of open edges that lie closer together than 1e-6 of the bounding box's diagonal, then 1e-5,
/// then 1e-4. A step is kept only if it reduces the number of open edges. From the second step on, no vertex
/// moves by more than a tenth of its shortest edge, so that detail does not collapse. Triangles that
/// degenerate to a line are removed.
BorderWeld weld_borders(TriangleMesh& mesh);

}  // namespace lamella
