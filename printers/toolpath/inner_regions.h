// What infill an island's inside takes, and where.
#pragma once

#include "printers/toolpath/toolpath.h"

namespace lamella {

/// A connected region inside the walls.
struct InnerRegion {
    enum class Fill { sparse, solid, bridge };
    Polygons region;
    Fill fill = Fill::solid;
    dvec2 along{0};  ///< of a bridge: the direction of its lines, of unit length
};

/// Infill of this density and more is solid.
inline constexpr double densest_lattice = 0.999;

/// Divides a connected region inside the walls: solid where the core of the layers round it ends, and
/// everywhere at full density; what hangs of that is a bridge, with a strip beside it that anchors its lines.
/// Sparse regions that are hardly larger than their border become solid.
std::vector<InnerRegion> divide_inside(const Polygons& region, const LayerNeighborhood& around,
                                       double density, const LineSettings& line);

}  // namespace lamella
