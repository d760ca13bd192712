// BallExtentTable: one quarter of the ball is computed, the others are its mirror images.
#include "engine/morphology/ball_extents.h"

#include <cmath>

namespace lamella {
namespace {

double square(std::int32_t count, double pitch) {
    if (count == 0) return 0;  // pitches may be infinite
    const double distance = count * pitch;
    return distance * distance;
}

}  // namespace

BallExtentTable::BallExtentTable(const LayerLattice& lattice, double weight) : weight_(weight) {
    constexpr std::size_t max_entries = std::size_t{1} << 22;
    const double radius = std::sqrt(weight);
    // One more than needed, in case the division rounded down.
    const std::size_t lines = lattice.lines_within(radius) + 1, layers = lattice.layers_within(radius) + 1;
    const bool fits =
        lines <= max_entries && layers <= max_entries && 4 * (lines + edge) * (layers + edge) <= max_entries;
    if (fits) {
        lines_ = static_cast<std::int32_t>(lines);
        layers_ = static_cast<std::int32_t>(layers);
    } else {
        weight_ = -1;  // no table
    }
    const auto rows = 2 * static_cast<std::size_t>(layers_ + edge) + 1;
    ahead_.assign(stride() * rows, none);
    back_ = ahead_;
    if (!fits) return;
    for (std::int32_t z = 0; z <= layers_; ++z) {
        for (std::int32_t l = 0; l <= lines_; ++l) {
            const double left = weight - square(l, lattice.row_pitch) - square(z, lattice.layer_pitch);
            if (left < 0) break;
            const RoundedExtent reach(std::sqrt(left));
            for (const std::size_t i : {place(-z, -l), place(-z, l), place(z, -l), place(z, l)}) {
                ahead_[i] = reach.ahead;
                back_[i] = reach.back;
            }
        }
    }
}

}  // namespace lamella
