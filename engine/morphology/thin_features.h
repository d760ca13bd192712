// Thin features: points outside the dilated erosion (the opening with slack) of a solid or of the void.
#pragma once

#include <deque>

#include "engine/morphology/dilated_difference.h"
#include "engine/morphology/row_bitmask.h"

namespace lamella {

/// The criterion for too thin: a point farther than `radius` + `slack` from every ball centre, that is, from
/// every point where a ball of `radius` fits wholly. Lengths in run units.
///
/// Without slack these are the points that an opening removes (Williams and Rossignac 2005: not stable). They
/// include every sharp edge, although a machine merely rounds it. A slack of half the radius excuses edges of
/// 84 degrees and more, a slack of one and a half radii excuses edges of 47 degrees and more. Thin walls and
/// struts are found if they stand out farther than the slack.
struct Thinness {
    double radius = 0;
    double slack = 0;
};

/// The medium to measure: walls are thin parts of the solid, gaps are narrow parts of the void.
enum class FeatureKind : unsigned char { wall, gap };

/// Returns how many rows beyond a layer's matter to whether points of the layer are too thin.
std::size_t margin_of(const Thinness& thinness, double row_pitch);
/// Returns the rows with `margin` empty rows added on either side.
RunRows widened(const RunRows& rows, std::size_t margin);

/// Finds the points of a layer's solid, or of its void, that are too thin within the layer. `out` gets as
/// many rows as `rows`. `row_pitch` in run units.
void thin_rows(const RunRows& rows, FeatureKind kind, const Thinness& thinness, double row_pitch,
               RunRows& out);
/// Returns how far beyond a layer's rows (run units) the cells passed to the thin_rows below must extend. 0
/// if that function does not read them, because coarser cells that it makes itself are good enough.
double reach_of_cells(const Thinness& thinness);
/// Does the same with cells made beforehand, to share them between checks. They extend to reach_of_cells.
void thin_rows(const RunRows& rows, const LayerCells& cells, FeatureKind kind, const Thinness& thinness,
               double row_pitch, RunRows& out);

/// Finds the too thin points of a stream of layers, with a ball that extends across layers. Outside the given
/// lines and layers all is void. Layers come out in the order in which they were pushed, each as soon as all
/// layers that decide about it are known. Used like DilationStream.
class ThinFeatureStream {
  public:
    ThinFeatureStream(const LayerLattice& lattice, const Thinness& thinness,
                      FeatureKind kind = FeatureKind::wall);
    void push(const RunRows& layer);
    void finish();
    bool pop(RunRows& out);

  private:
    void push_wide(RunRows layer);
    void push_beyond();
    void carry_on();

    FeatureKind kind_;
    std::size_t lines_, margin_;    // lines of the lattice, and extra ones on either side
    std::size_t beyond_;            // empty layers added below the first and above the last
    std::size_t to_drop_;           // empty layers below the first that have not come out yet
    std::size_t to_come_ = 0;       // layers that went in and have not come out yet
    std::deque<RunRows> of_;        // the measured medium, of layers whose ball centres are not known yet
    DilatedDifferenceStream core_;  // ball centres: the medium minus its dilated complement
    DilatedDifferenceStream thin_;  // the medium minus the dilated ball centres
};

}  // namespace lamella
