// MedialAxis: the centres of the inscribed discs that touch the border at two points or more.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "printers/polygons/polygons.h"

namespace lamella {

/// A centre of an inscribed disc, mm.
struct MedialNode {
    dvec2 at{0};
    double radius = 0;  ///< distance to the border; 0 on it
};

/// A straight piece of the axis. Curved pieces are split into several.
struct MedialEdge {
    std::array<std::uint32_t, 2> node{};  ///< nodes at its ends
    /// Points where the discs at both ends touch the border, to the left and to the right of the edge.
    std::array<dvec2, 2> left{}, right{};
};

struct MedialAxis {
    std::vector<MedialNode> nodes;
    std::vector<MedialEdge> edges;
};

/// Computes the axis inside one connected piece with its holes: in closed form where that can be, else from
/// the Voronoi diagram of its border. The borders must not cross. Curved pieces are approximated to
/// `tolerance` mm. Empty if there is no valid axis, such as for borders that do cross.
MedialAxis medial_axis(const Polygons& piece, double tolerance);

/// Computes the axis in closed form, which is many times faster. Nothing where that fails, as for pieces of
/// very many corners.
std::optional<MedialAxis> traced_medial_axis(const Polygons& piece, double tolerance);

}  // namespace lamella
