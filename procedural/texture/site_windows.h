// SiteWindows: the square neighbourhood of each site, flattened by walking over the surface.
#pragma once

#include <cstdint>
#include <vector>

#include "procedural/texture/surface_sites.h"

namespace lamella {

/// For each site the sites that lie at the offsets of a window of `size` x `size`, one spacing apart.
struct SiteWindows {
    int size = 9;                      ///< odd
    std::vector<std::uint32_t> sites;  ///< site by site, row by row, the lowest row first

    int radius() const { return size / 2; }
    std::size_t area() const { return static_cast<std::size_t>(size) * static_cast<std::size_t>(size); }
    /// Returns the place of an offset within a window.
    std::size_t place(int across, int up) const {
        const int row = up + radius(), column = across + radius();
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(size) +
               static_cast<std::size_t>(column);
    }
    std::span<const std::uint32_t> of(std::size_t site) const {
        return std::span(sites).subspan(site * area(), area());
    }
};

/// Finds the windows by a discrete exponential map: from offset to offset outward, each step goes to the
/// neighbour whose coordinates are nearest. A site's coordinates are those of the site before it, plus the
/// step in that site's tangent plane, stretched to the step's length and turned by the angle between the
/// frames. So windows go on across creases. Where sites end, offsets repeat the last ones. Throws InputError
/// for a size that is even, below 3 or above 11.
SiteWindows site_windows(const SurfaceSites& sites, int size);

}  // namespace lamella
