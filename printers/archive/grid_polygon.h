// Contours on a fine grid, as files with points of their own precision hold them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/contours/contours.h"

namespace lamella {

/// Decimals of a mm that the grid keeps: 0.1 um.
inline constexpr int grid_decimals = 4;
inline constexpr double grid_units_per_mm = 1e4;

/// A closed polygon without a repeated last point, in units of the grid; no two points in succession are
/// equal.
struct GridPolygon {
    std::vector<std::array<std::int64_t, 2>> points;
    bool hole = false;  ///< clockwise
};

/// The contours on the grid, halves away from zero. What has less than three points there is left out.
std::vector<GridPolygon> on_grid(const std::vector<Contour>& contours);

/// Area inside, mm^2: of outlines less their holes.
double total_area(const std::vector<Contour>& contours);

}  // namespace lamella
