// VoxelGrid: the solid of a part, one bit a cell, with a pyramid of densities for ambient light.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/field/field.h"

namespace lamella {

/// Positions are in cells from the grid's lower corner: one cell is one unit.
class VoxelGrid {
  public:
    /// The cells along a run that become solid: all that it touches, so that nothing visible is lost, or
    /// those whose centre it covers, so that nothing looks thicker.
    enum class Mark : unsigned char { touched, covered };

    /// Cuts the part into planes and marks the cells of their runs within the bounds. `cells` is the number
    /// of cells along the longest side. Uses the calling task arena's threads.
    VoxelGrid(const Field& part, const Box& bounds, int cells, Mark mark = Mark::touched);

    double pitch() const { return pitch_; }  ///< edge of a cell, mm
    dvec3 to_grid(dvec3 p) const { return (p - origin_) / pitch_; }
    dvec3 to_part(dvec3 g) const { return origin_ + g * pitch_; }
    dvec3 size() const { return {nx_, ny_, nz_}; }

    /// Returns the centres, in part coordinates, of coarse cells (8 cells wide) with any solid.
    std::vector<dvec3> solid_places() const;

    /// Returns the interval of the ray in the first solid cell at or after `from`; nothing when the ray
    /// leaves the grid first.
    std::optional<Interval> next_solid(dvec3 start, dvec3 direction, double from, double to) const;

    /// Returns true if the cell at a position is solid.
    bool solid_at(dvec3 p) const;

    /// Returns the gradient of the density at a position, per cell; zero where the density is uniform.
    dvec3 slope(dvec3 p) const;

    /// Returns the share of light that arrives through a cone, 1 for all. The cone's width grows by `spread`
    /// cells a cell.
    double cone(dvec3 start, dvec3 direction, double spread, double reach) const;

  private:
    /// Densities with a border of empty cells, so that every position has eight neighbours for interpolation.
    struct Level {
        int nx, ny, nz;
        double per_cell;                    ///< cells of this level per cell of the grid
        std::vector<std::uint8_t> density;  ///< 255 full; 0 only if all finer cells are empty

        Level(int x, int y, int z, double cells)
            : nx(x), ny(y), nz(z), per_cell(cells), density(plane() * (static_cast<std::size_t>(z) + 2)) {}
        std::size_t row() const { return static_cast<std::size_t>(nx) + 2; }
        std::size_t plane() const { return row() * (static_cast<std::size_t>(ny) + 2); }
        std::size_t at(int x, int y, int z) const {
            return static_cast<std::size_t>(z + 1) * plane() + static_cast<std::size_t>(y + 1) * row() +
                   static_cast<std::size_t>(x + 1);
        }
    };

    bool holds(glm::ivec3 cell) const {
        return cell.x >= 0 && cell.y >= 0 && cell.z >= 0 && cell.x < nx_ && cell.y < ny_ && cell.z < nz_;
    }
    bool solid(int x, int y, int z) const {
        return bits_[row(y, z) + static_cast<std::size_t>(x >> 6)] >> (x & 63) & 1U;
    }
    /// Returns the index of a row's first word.
    std::size_t row(int y, int z) const {
        return words_ *
               (static_cast<std::size_t>(z) * static_cast<std::size_t>(ny_) + static_cast<std::size_t>(y));
    }
    void mark_plane(const Field& part, const Box& bounds, int z, Mark mark);
    void build_pyramid();
    Level first_level() const;
    static Level level_above(const Level& below);
    int empty_doublings(glm::ivec3 cell) const;
    double density(std::size_t level, dvec3 p) const;

    dvec3 origin_;
    double pitch_;
    int nx_, ny_, nz_;
    std::size_t words_;  ///< words of 64 cells in a row along x
    std::vector<std::uint64_t> bits_;
    std::vector<Level> levels_;  ///< level k has cells of edge 2^(k+1)
};

}  // namespace lamella
