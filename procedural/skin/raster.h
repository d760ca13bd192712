// TiledMask: a bit mask that tiles the plane, with its distance transform and connected components.
#pragma once

#include <cstdint>
#include <vector>

namespace lamella {

/// The pixels, row by row, of a mask that repeats in both directions.
struct TiledMask {
    int width = 0, height = 0;
    std::vector<std::uint8_t> marked;  ///< 1 or 0

    TiledMask(int w, int h)
        : width(w), height(h), marked(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), 0) {}
    /// Returns the index of a pixel. Coordinates may exceed the tile by up to one width or height; they wrap
    /// around.
    std::size_t index(int x, int y) const {
        x = x < 0 ? x + width : x >= width ? x - width : x;
        y = y < 0 ? y + height : y >= height ? y - height : y;
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    }
    std::size_t count() const;
};

/// Larger than any squared distance between pixels; the result where nothing is marked.
inline constexpr std::int64_t no_pixel = std::int64_t{1} << 40;

/// Returns the squared distance of each pixel to the nearest marked one, px^2, exact (Felzenszwalb and
/// Huttenlocher 2012, Distance transforms of sampled functions). Copies of the tile within one width and
/// height are included.
std::vector<std::int64_t> squared_distances(const TiledMask& mask);

/// An 8-connected component of marked pixels, also across the tile's border.
struct TiledComponent {
    std::vector<std::uint32_t> pixels;  ///< indices
    bool goes_on = false;               ///< connects a pixel to a copy of itself in another tile
};
std::vector<TiledComponent> components_of(const TiledMask& mask);

}  // namespace lamella
