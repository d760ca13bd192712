// Balls for thicknesses, less what sampling hides.
#include "engine/morphology/sampled_ball.h"

#include <cmath>

#include "engine/base/error.h"

namespace lamella {

LayerLattice ball_lattice(const RowBand& band, double layer_height, double across, double up) {
    if (!(across > 0 && up > 0)) throw InputError("a ball reaches farther than nothing in all directions");
    const double unit = std::abs(band.along_pitch) / run_unit;
    return {std::abs(band.line_pitch()) / unit, layer_height * (across / up) / unit,
            static_cast<std::size_t>(band.lines())};
}

SampledBall sampled_ball(const RowBand& band, double layer_height, double thickness, double thickness_up) {
    const double across = thickness - std::abs(band.line_pitch()), up = thickness_up - layer_height;
    if (!(across > 0)) throw InputError("rows as far apart as a thickness cannot tell it");
    const double radius = 0.5 * across / std::abs(band.along_pitch) * run_unit;
    if (up > 0) return {ball_lattice(band, layer_height, across, up), radius};
    LayerLattice flat = ball_lattice(band, layer_height, across, across);
    flat.layer_pitch = infinity;
    return {flat, radius};
}

}  // namespace lamella
