// Thin features: points outside the dilated erosion (the opening with slack) of a solid or of the void.
#pragma once

#include <deque>

#include "engine/morphology/dilated_difference.h"
#include "engine/morphology/row_bitmask.h"

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

/// What is measured: the solid, or the void between it.
enum class FeatureKind : unsigned char { wall, gap };

/// Rows beyond a layer's that decide about them.
std::size_t margin_of(const Thinness& thinness, double row_pitch);
/// Rows with `margin` empty ones on either side.
RunRows widened(const RunRows& rows, std::size_t margin);

/// What of a layer's rows, or of the void between them, is too thin within the layer.
void thin_rows(const RunRows& rows, FeatureKind medium, const Thinness& thinness, double row_pitch,
               RunRows& out);
/// How far cells must be known beside a layer's rows, run units, to tell what is too thin: not at all where
/// larger cells, made for it alone, tell as well.
double reach_of_cells(const Thinness& thinness);
/// The same where the rows' cells are known so far.
void thin_rows(const RunRows& rows, const LayerCells& cells, FeatureKind medium, const Thinness& thinness,
               double row_pitch, RunRows& out);

/// What is too thin in layers, by a ball that reaches from layer to layer; beside the lines and layers given
/// all is void. Layers come out in the order in which they went in, once all are known that the ball reaches.
class ThinFeatureStream {
  public:
    ThinFeatureStream(const LayerLattice& lattice, const Thinness& thinness,
                      FeatureKind medium = FeatureKind::wall);
    void push(const RunRows& layer);
    void finish();
    bool pop(RunRows& out);

  private:
    void push_wide(RunRows layer);
    void push_beyond();
    void carry_on();

    FeatureKind medium_;
    std::size_t lines_, margin_;    // of the lattice, and beside it on either side
    std::size_t beyond_;            // empty layers before the first and behind the last
    std::size_t to_drop_;           // of those before
    std::size_t to_come_ = 0;       // layers that went in and did not come out yet
    std::deque<RunRows> of_;        // what is measured, of layers where it is not known where the ball fits
    DilatedDifferenceStream core_;  // where the middle of a ball may be
    DilatedDifferenceStream thin_;  // what lies far from there
};

}  // namespace lamella
