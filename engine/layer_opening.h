// Layers opened and closed by a ball while they stream: what is thinner than it, and gaps that it does not
// fit.
#pragma once

#include "engine/layer_offset.h"

namespace lamella {

/// The lattice of layers whose rows lie in a band, for a ball that reaches `across` mm within a layer and
/// `up` mm from layer to layer, which are `layer_height` mm high. Its radius is `across` in run units of the
/// band.
LayerLattice ball_lattice(const RowBand& band, double layer_height, double across, double up);

/// What balls cover that lie in the solid wholly: the solid without all that is thinner than the ball (the
/// opening; Williams and Rossignac 2005 call what stays stable). Ends are right to a unit.
class OpenedLayers {
  public:
    OpenedLayers(const LayerLattice& lattice, double radius);
    void push(const SpanRows& layer);
    void finish();
    bool pop(SpanRows& out) { return grown_.pop(out); }

  private:
    void carry_on();

    double radius_;
    ShrinkingLayers shrunk_;
    GrowingLayers grown_;
};

/// The solid with all of the void that no ball covers which lies in the void wholly: gaps and holes narrower
/// than the ball are filled (the closing). Ends are right to a unit.
class ClosedLayers {
  public:
    ClosedLayers(const LayerLattice& lattice, double radius);
    void push(const SpanRows& layer);
    void finish();
    bool pop(SpanRows& out);

  private:
    void push_empty();
    void carry_on();

    double radius_;
    std::size_t lines_, margin_;  // of the lattice, and beside it on either side
    std::size_t beyond_;          // layers below and above that a ball reaches
    std::size_t to_drop_;         // of those below
    std::size_t to_come_ = 0;     // layers that went in and did not come out yet
    GrowingLayers grown_;
    ShrinkingLayers shrunk_;
};

}  // namespace lamella
