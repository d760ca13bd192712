// Connected pieces of a pattern, and the lines that join them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "procedural/texture/surface_sites.h"

namespace lamella {

/// Components of the sites with values above 0 over neighbours.
struct SitePieces {
    static constexpr std::uint32_t none = 0xffffffff;
    std::vector<std::uint32_t> piece;  ///< by site; `none` where the value is not above 0
    std::vector<std::size_t> sizes;    ///< by piece, sites
};

SitePieces pieces_of(const SurfaceSites& sites, std::span<const float> values);

/// Returns the lines, as sites, that join all pieces which the surface connects: the shortest ones, as a
/// minimum spanning tree, where a step of a line is as long as it is times 1 plus the mean reluctance of its
/// ends, by site. So lines go where the pattern nearly had material. Each line ends inside two pieces.
std::vector<std::vector<std::uint32_t>> lines_between(const SurfaceSites& sites, const SitePieces& pieces,
                                                      std::span<const float> reluctance);

}  // namespace lamella
