// Opening and closing of a stream of layers by a ball: removes thin walls, fills narrow gaps.
#pragma once

#include "engine/morphology/layer_offset.h"

namespace lamella {

/// The lattice of layers whose rows lie in a band, for a ball that reaches `across` mm within a layer and
/// `up` mm from layer to layer, which are `layer_height` mm high. Its radius is `across` in run units of the
/// band.
LayerLattice ball_lattice(const RowBand& band, double layer_height, double across, double up);

/// A ball that fits into all that is at least so thick, on a lattice that knows lengths to a pitch.
struct SampledBall {
    LayerLattice lattice;
    double radius;  ///< run units
};

/// The ball for a thickness (mm) within layers and one upright. Rows see a thickness up to the way between
/// two of them less than it is, and layers up to one of them: so much smaller is the ball. One that is no
/// thicker than a layer upright stays within its layer. Throws InputError where the thickness is no more than
/// a way between rows.
SampledBall sampled_ball(const RowBand& band, double layer_height, double thickness, double thickness_up);

/// What balls cover that lie in the solid wholly: the solid without all that is thinner than the ball (the
/// opening; Williams and Rossignac 2005 call what stays stable). Ends are right to a unit. With slack, run
/// units, all that lies no further than it from there belongs to it, too.
class OpeningStream {
  public:
    OpeningStream(const LayerLattice& lattice, double radius, double slack = 0);
    void push(const RunRows& layer);
    void finish();
    bool pop(RunRows& out) { return grown_.pop(out); }

  private:
    void carry_on();

    double reach_;  // of what is grown again
    ErosionStream shrunk_;
    DilationStream grown_;
};

/// The solid with all of the void that no ball covers which lies in the void wholly: gaps and holes narrower
/// than the ball are filled (the closing). Ends are right to a unit. With slack, run units, all that lies no
/// further than it from such a ball stays void, too.
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
    std::size_t lines_, margin_;  // of the lattice, and beside it on either side
    std::size_t beyond_;          // layers below and above that a ball reaches
    std::size_t to_drop_;         // of those below
    std::size_t to_come_ = 0;     // layers that went in and did not come out yet
    DilationStream grown_;
    ErosionStream shrunk_;
};

}  // namespace lamella
