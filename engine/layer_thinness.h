// What is thinner than a ball in layers that stream by, and which gaps are narrower.
#pragma once

#include <deque>

#include "engine/layer_opening.h"

namespace lamella {

/// What counts as too thin: points that lie further than `radius` + `slack` from every place where a ball of
/// `radius` fits wholly. Lengths in run units.
///
/// Without slack that is what an opening takes away (Williams and Rossignac 2005: what is not stable), and
/// with it every sharp edge, though a machine does no worse than to round it. A slack of half of the radius
/// excuses edges of 84 degrees and more, one of one and a half of it those of 47 degrees; walls and struts
/// are found that stand out further than it.
struct Thinness {
    double radius = 0;
    double slack = 0;
};

/// The points of a layer's rows that are too thin within the layer.
void thin_rows(const SpanRows& rows, const Thinness& thinness, double row_pitch, SpanRows& out);
/// The void between the rows' solid that is too narrow, by the same measure.
void narrow_rows(const SpanRows& rows, const Thinness& thinness, double row_pitch, SpanRows& out);

/// What is too thin in layers, by a ball that reaches from layer to layer. Layers come out in the order in
/// which they went in, once all are known that the ball reaches.
class ThinLayers {
  public:
    ThinLayers(const LayerLattice& lattice, const Thinness& thinness)
        : opened_(lattice, thinness.radius, thinness.slack) {}
    void push(const SpanRows& layer);
    void finish() { opened_.finish(); }
    /// Takes the next layer. False where further layers have to be pushed first, or there are no more.
    bool pop(SpanRows& out);

  private:
    std::deque<SpanRows> solid_;  // layers that did not come out yet
    OpenedLayers opened_;
};

/// The same for the void.
class NarrowLayers {
  public:
    NarrowLayers(const LayerLattice& lattice, const Thinness& thinness)
        : closed_(lattice, thinness.radius, thinness.slack) {}
    void push(const SpanRows& layer);
    void finish() { closed_.finish(); }
    bool pop(SpanRows& out);

  private:
    std::deque<SpanRows> solid_;
    ClosedLayers closed_;
};

}  // namespace lamella
