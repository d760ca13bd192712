// GridPolygon: contours rounded to a fine grid, for file formats with a fixed precision.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/contours/contours.h"

namespace lamella {

/// Decimals of a mm on the grid: 0.1 um.
inline constexpr int grid_decimals = 4;
inline constexpr double grid_units_per_mm = 1e4;

/// A closed polygon in grid units, without a repeated last point. No two successive points are equal.
struct GridPolygon {
    std::vector<std::array<std::int64_t, 2>> points;
    bool hole = false;  ///< clockwise
};

/// Rounds contours to the grid, halves away from zero. Drops contours with fewer than three distinct
/// successive points.
std::vector<GridPolygon> on_grid(const std::vector<Contour>& contours);

/// Returns the area of the outer contours less that of the holes, mm^2.
double total_area(const std::vector<Contour>& contours);

}  // namespace lamella
