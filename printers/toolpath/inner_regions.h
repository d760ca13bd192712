// Division of an island's interior into sparse infill, solid infill and bridges.
#pragma once

#include "printers/toolpath/toolpath.h"

namespace lamella {

/// A connected region inside the walls.
struct InnerRegion {
    enum class Fill { sparse, solid, bridge };
    Polygons region;
    Fill fill = Fill::solid;
    dvec2 along{0};  ///< unit direction of a bridge's lines
};

/// Infill above this density is solid.
inline constexpr double densest_lattice = 0.999;

/// Divides a connected region inside the walls. It is solid outside the `core` (where the layers around it
/// are solid), and everywhere at full density. Unsupported solid parts are bridges, with a strip of their
/// surroundings that anchors their lines. Sparse regions hardly larger than their border become solid.
std::vector<InnerRegion> divide_inside(const Polygons& region, const LayerNeighborhood& around,
                                       double density, const LineSettings& line);

}  // namespace lamella
