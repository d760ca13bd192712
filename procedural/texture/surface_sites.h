// SurfaceSites: points spread evenly over a surface, and which of them are neighbours.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/geometry.h"

namespace lamella {

/// The points of a surface on which a pattern is computed.
struct SurfaceSites {
    static constexpr std::uint32_t none = 0xffffffff;

    double spacing = 1;                   ///< mean distance of neighbours along an axis, mm
    std::vector<dvec3> places;            ///< mm
    std::vector<dvec3> normals;           ///< unit vectors, outward
    std::vector<dvec3> tangents;          ///< unit vectors at right angles to the normals: the pattern's x
    std::vector<std::uint32_t> first;     ///< of each site in `adjacent`, and the end
    std::vector<std::uint32_t> adjacent;  ///< neighbours, site by site
    /// By site the one on the other side of a thin wall, or `none`; empty where no wall is thin.
    std::vector<std::uint32_t> across;
    /// By site near a sharp edge of the body the nearest one on the other face, or `none`; empty where no
    /// edge is sharp.
    std::vector<std::uint32_t> over_edge;
    dvec3 period{0};  ///< mm; 0 along axes along which the sites do not repeat

    std::size_t size() const { return places.size(); }
    std::span<const std::uint32_t> neighbours(std::size_t site) const {
        return std::span(adjacent).subspan(first[site], first[site + 1] - first[site]);
    }
    /// Returns the way from one place to another, the shortest of all copies.
    dvec3 way(dvec3 from, dvec3 to) const {
        dvec3 way = to - from;
        for (int axis = 0; axis < 3; ++axis) {
            if (period[axis] > 0 && std::abs(way[axis]) > 0.5 * period[axis])
                way[axis] -= period[axis] * std::round(way[axis] / period[axis]);
        }
        return way;
    }
};

/// Returns the sites of a flat sheet that tiles the plane z = 0: the centres of `width` x `height` squares,
/// row by row, each with its eight neighbours. The pattern's x is the sheet's. Throws InputError for less
/// than three squares along a side.
SurfaceSites flat_sites(int width, int height, double spacing);

/// Returns for each place the nearest of the sites, the lowest number of equally near ones. Looks at sites
/// within two spacings whose normals do not point to the opposite side; a place without such a site gets the
/// nearest one at any distance.
std::vector<std::uint32_t> nearest_sites(const SurfaceSites& sites, std::span<const dvec3> places,
                                         std::span<const dvec3> normals);

}  // namespace lamella
