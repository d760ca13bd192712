// DensityPyramid: shares of material in cells and in ever larger blocks of cells, for surfaces and for light.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/geometry.h"

namespace lamella {

/// Cells beyond a plane count as empty: where the side towards the eye is cut away.
struct PreviewCut {
    int axis = -1;    ///< -1: nothing is cut
    double at = 0;    ///< position along the axis
    double side = 1;  ///< +1: the side above `at` is removed

    bool removes(dvec3 p) const { return axis >= 0 && (p[axis] - at) * side > 0; }
};

/// Level 0 holds the depths of cells (see plane_depths.h) plus 128, level k the shares of material in blocks
/// of 2^k cells along each edge. Positions are in cells. Memory: 8/7 bytes a cell.
class DensityPyramid {
  public:
    /// Shares with a border of empty cells, so that every position has the neighbours that interpolation
    /// needs.
    struct Level {
        static constexpr std::uint8_t border = 2;
        int nx, ny, nz;
        float per_cell;                     ///< blocks of this level per cell
        std::vector<std::uint8_t> density;  ///< 255 full; 0 only if all finer cells are empty

        Level(glm::ivec3 size, float cells);
        std::size_t row() const { return static_cast<std::size_t>(nx) + std::size_t{2} * border; }
        std::size_t plane() const { return row() * (static_cast<std::size_t>(ny) + std::size_t{2} * border); }
        std::size_t at(int x, int y, int z) const {
            const auto within = [](int i) {
                return static_cast<std::size_t>(std::ptrdiff_t{i} + std::ptrdiff_t{border});
            };
            return within(z) * plane() + within(y) * row() + within(x);
        }
    };

    explicit DensityPyramid(glm::ivec3 cells);
    /// The cells, to be filled before `finish` builds the levels above.
    Level& cells() { return levels_.front(); }
    const Level& cells() const { return levels_.front(); }
    void finish();

    dvec3 size() const { return {cells().nx, cells().ny, cells().nz}; }
    const Level& level(std::size_t k) const { return levels_[std::min(k, levels_.size() - 1)]; }

    /// Returns the gradient of the cells' shares at a position, smoothed by cubic B-splines; zero where they
    /// are uniform.
    dvec3 slope(dvec3 p) const;

    /// Returns the share of light that arrives through a cone from afar, 1 for all. The cone's width grows by
    /// `spread` cells a cell.
    float cone(dvec3 start, dvec3 direction, double spread, double reach, const PreviewCut& cut) const;

  private:
    float density(const Level& level, glm::vec3 p) const;

    std::vector<Level> levels_;
};

}  // namespace lamella
