// BruteForceDilation: layer by layer, adds all runs of all lines within reach of the block.
#include "engine/morphology/brute_force_dilation.h"

#include <algorithm>
#include <cmath>

namespace lamella {

BruteForceDilation::BruteForceDilation(const LayerLattice& lattice, const BallExtentTable& reaches,
                                       Run extent, std::int32_t max_layers, double max_weight)
    : union_(lattice, reaches, extent, max_layers) {
    const auto square = [](std::size_t count, double pitch) {
        if (count == 0) return 0.0;  // pitches may be infinite
        const double distance = static_cast<double>(count) * pitch;
        return distance * distance;
    };
    for (std::size_t up = 0;; ++up) {
        const double left = max_weight - square(up, lattice.layer_pitch);
        if (left < 0) break;
        std::size_t lines = lattice.lines_within(std::sqrt(left));
        if (left >= square(lines + 1, lattice.row_pitch)) ++lines;  // the division rounded down
        beside_.push_back(lines);
    }
}

void BruteForceDilation::grow(const LineBlock& block, std::span<const WeightedRows* const> layers) {
    union_.begin(block);
    const auto reach = static_cast<std::int32_t>(beside_.size()) - 1;
    const std::int32_t first_layer = std::max(block.layer - reach, 0),
                       end_layer = std::min(block.layer + block.layers + reach,
                                            static_cast<std::int32_t>(layers.size()));
    const auto line = static_cast<std::size_t>(block.line);
    for (std::int32_t z = first_layer; z < end_layer; ++z) {
        const WeightedRows& rows = *layers[static_cast<std::size_t>(z)];
        const std::size_t beside =
            beside_[static_cast<std::size_t>(LinesAway(z, block.layer, block.layers).least)];
        const std::size_t first = line - std::min(line, beside),
                          end = std::min(line + static_cast<std::size_t>(block.lines) + beside, rows.lines());
        union_.add(rows, z, rows.start(first), rows.start(end));
    }
    union_.unite();
}

}  // namespace lamella
