// The medial axis of polygons: where the discs that touch the border twice have their centres.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "printers/polygons/polygons.h"

namespace lamella {

/// A centre of such a disc, mm.
struct MedialNode {
    dvec2 at{0};
    double radius = 0;  ///< distance to the border; 0 on it
};

/// A straight piece of the axis. Curved ones come as several.
struct MedialEdge {
    std::array<std::uint32_t, 2> node{};  ///< at its ends
    /// Where the discs at either end touch the border, to the left of the edge and to its right.
    std::array<dvec2, 2> left{}, right{};
};

struct MedialAxis {
    std::vector<MedialNode> nodes;
    std::vector<MedialEdge> edges;
};

/// The axis inside one connected piece with its holes, whose borders must not cross (from the Voronoi diagram
/// of its border; curved stretches are followed to `tolerance` mm). Empty when there is none that makes
/// sense, as for borders that do cross.
MedialAxis medial_axis(const Polygons& piece, double tolerance);

}  // namespace lamella
