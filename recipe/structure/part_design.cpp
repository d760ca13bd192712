// The level that keeps the volume, before and after stray pieces are gone.
#include "recipe/structure/part_design.h"

namespace lamella {

std::size_t cut_shape(DensityGrid& grid, Interval volume, std::span<const std::uint8_t> anchored,
                      std::span<const std::uint8_t> loaded) {
    constexpr double cut = 0.5;
    extend_outside(grid, extended_layers);
    double level = volume_keeping_level(grid, volume.hi);
    std::size_t pieces = 0;
    // A lower level keeps the volume without stray pieces, and others may appear at it.
    constexpr int most_rounds = 20;
    for (int round = 0;; ++round) {
        const StrayPieces stray = drop_stray_pieces(grid, level, anchored, loaded);
        pieces += stray.pieces;
        if (stray.pieces == 0) break;
        extend_outside(grid, extended_layers);
        if (round < most_rounds && solid_volume(grid, level) < volume.lo)
            level = volume_keeping_level(grid, volume.lo);
    }
    for (double& d : grid.density) d += cut - level;
    return pieces;
}

}  // namespace lamella
