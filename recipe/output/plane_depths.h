// PlaneDepths: how deep the cells of one plane lie inside a solid, from exact runs along rows and columns.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/geometry.h"
#include "engine/runs/runs.h"

namespace lamella {

/// Depths are signed distances in the plane from the centres of cells to the border of the solid: positive
/// inside, never 0, and cut off at `depth_reach` cells.
inline constexpr int depth_reach = 4;
inline constexpr int depth_unit = 32;               ///< a cell
inline constexpr std::uint8_t surface_depth = 128;  ///< stands for depth 0 where depths have no sign
inline constexpr int full_depth = depth_reach * depth_unit - 1;  ///< this far inside, or farther

/// The depths of a plane, row by row. Reused from plane to plane.
class PlaneDepths {
  public:
    PlaneDepths(int columns, int rows);

    /// Replaces the depths by those of a solid with these runs: of the lines through the centres of the rows,
    /// and of the columns. Runs are in cells and lie within the plane.
    void set(const RunRows& rows, const RunRows& columns);
    /// Returns the depths row by row, each plus `surface_depth`.
    const std::vector<std::uint8_t>& depths() const { return depths_; }

  private:
    std::size_t at(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(x);
    }
    void find_uniform(int x);
    void combine(int y);
    void limit_steps(int y);

    int columns_, rows_;
    std::vector<std::int8_t> along_, across_;  ///< across_ is stored column by column
    std::vector<std::int8_t> uniform_;         ///< for eight rows and a column; 0: near the border
    std::vector<Run> runs_;
    std::vector<std::uint8_t> steep_, depths_;  ///< before and after steps are limited
};

}  // namespace lamella
