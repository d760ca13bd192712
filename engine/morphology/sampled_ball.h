// SampledBall: the ball that measures a thickness in layers sampled by rows.
#pragma once

#include "engine/morphology/layer_offset.h"

namespace lamella {

/// Returns the lattice of layers with the rows of `band`, for a ball that reaches `across` mm within a layer
/// and `up` mm along z. Layers are `layer_height` mm high. On this lattice the ball's radius is `across`,
/// converted to run units of the band. Throws InputError unless `across` and `up` are positive.
LayerLattice ball_lattice(const RowBand& band, double layer_height, double across, double up);

/// A ball that fits into every wall of some thickness, made smaller by the sampling error of its lattice.
struct SampledBall {
    LayerLattice lattice;
    double radius;  ///< run units
};

/// Returns the ball for a thickness (mm) within layers and a thickness along z (mm). Sampled by rows, a wall
/// may seem thinner by up to one row pitch, and sampled by layers by up to a layer height: the
/// ball's diameters are reduced by these. If no more than a layer's height is asked for along z, the ball
/// becomes a disc within its layer (infinite layer pitch). Throws InputError when `thickness` does not exceed
/// the row pitch.
SampledBall sampled_ball(const RowBand& band, double layer_height, double thickness, double thickness_up);

}  // namespace lamella
