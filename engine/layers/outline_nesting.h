// Outline nesting: places outlines on plates without overlap, also in each other's hollows.
#pragma once

#include <span>
#include <vector>

#include "engine/runs/runs.h"

namespace lamella {

/// A shape as it may be turned: rows of pixels, within run coordinates 0 and `width`.
struct NestTurn {
    RunRows rows;
    std::int32_t width = 0;  ///< run units
};

/// A shape to place.
struct NestShape {
    std::vector<NestTurn> turns;
    int copies = 1;
};

/// Where a copy of a shape lies.
struct NestPlace {
    std::size_t shape = 0, turn = 0;
    int plate = 0;       ///< from 0
    std::int32_t x = 0;  ///< of run coordinate 0, run units
    int y = 0;           ///< of line 0, rows
};

/// Places all copies of all shapes on plates of `width` run units and `height` rows, those of the largest
/// area first: on the first plate with room, turned so that the upper end is lowest, as low and then as far
/// left as can be. At least `gap` run units stay free between two shapes (Euclidean; rows are run_unit
/// apart). A pure function. Throws InputError, with the number of the shape, for one that does not fit on an
/// empty plate.
std::vector<NestPlace> nest_outlines(std::span<const NestShape> shapes, std::int32_t width, int height,
                                     std::int32_t gap);

}  // namespace lamella
