// Opening and closing of a stream of layers by a ball: removes thin walls, fills narrow gaps.
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
/// may seem thinner by up to the distance of two rows, and sampled by layers by up to a layer height: the
/// ball's diameters are reduced by these. If no more than a layer's height is asked for along z, the ball
/// becomes a disc within its layer (infinite layer pitch). Throws InputError when `thickness` does not exceed
/// the distance of two rows.
SampledBall sampled_ball(const RowBand& band, double layer_height, double thickness, double thickness_up);

/// Opening of a stream of layers by a ball: the union of all balls that lie within the solid. Removes
/// everything thinner than the ball (Williams and Rossignac 2005 call the rest stable). Run ends are exact to
/// a unit. With `slack` (run units) the result contains all points within `slack` of the opening, too. Used
/// like DilationStream; outside the lattice and the given layers all is void.
class OpeningStream {
  public:
    OpeningStream(const LayerLattice& lattice, double radius, double slack = 0);
    void push(const RunRows& layer);
    void finish();
    bool pop(RunRows& out) { return grown_.pop(out); }

  private:
    void carry_on();

    double reach_;  // of the dilation: radius + slack
    ErosionStream shrunk_;
    DilationStream grown_;
};

/// Closing of a stream of layers by a ball: the complement of the union of all balls that lie within the
/// void. Fills gaps and holes narrower than the ball. Run ends are exact to a unit. With `slack` (run units)
/// points within `slack` of such a ball stay void, too. Used like DilationStream.
class ClosingStream {
  public:
    ClosingStream(const LayerLattice& lattice, double radius, double slack = 0);
    void push(const RunRows& layer);
    void finish();
    bool pop(RunRows& out);

  private:
    void push_empty();
    void carry_on();

    double radius_;
    std::size_t lines_, margin_;  // lines of the lattice, and extra ones on either side
    std::size_t beyond_;          // extra layers below and above: as many as a ball reaches
    std::size_t to_drop_;         // extra layers below that have not come out yet
    std::size_t to_come_ = 0;     // layers that went in and have not come out yet
    DilationStream grown_;
    ErosionStream shrunk_;
};

}  // namespace lamella
