// Rasters of marked pixels that repeat over the plane: distances and components.
#pragma once

#include <cstdint>
#include <vector>

namespace lamella {

/// Pixels of a tile that repeats in both directions, row by row.
struct TiledMask {
    int width = 0, height = 0;
    std::vector<std::uint8_t> marked;  ///< 1 or 0

    TiledMask(int w, int h)
        : width(w), height(h), marked(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), 0) {}
    /// The index of a pixel; coordinates wrap round once.
    std::size_t index(int x, int y) const {
        x = x < 0 ? x + width : x >= width ? x - width : x;
        y = y < 0 ? y + height : y >= height ? y - height : y;
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    }
    std::size_t count() const;
};

/// What no pixel is as far away as: the squared distance where nothing is marked.
inline constexpr std::int64_t no_pixel = std::int64_t{1} << 40;

/// The square of each pixel's distance to the nearest marked one, px^2, exact (Felzenszwalb and Huttenlocher
/// 2012, Distance transforms of sampled functions), over all copies of the tile within one width and height.
std::vector<std::int64_t> squared_distances(const TiledMask& mask);

/// Marked pixels that hang together over sides or corners, also across the tile's border.
struct TiledComponent {
    std::vector<std::uint32_t> pixels;  ///< indices
    bool goes_on = false;               ///< leads from a pixel to a copy of the same pixel
};
std::vector<TiledComponent> components_of(const TiledMask& mask);

}  // namespace lamella
