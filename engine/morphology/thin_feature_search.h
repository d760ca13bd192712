// ThinFeatureSearch: streams thin walls and narrow gaps, searching for ball centres lazily (the fast path of
// ThinFeatureStream).
#pragma once

#include <deque>
#include <vector>

#include "engine/morphology/ball_centers_by_run.h"
#include "engine/morphology/dilated_difference.h"
#include "engine/morphology/thin_features.h"
#include "engine/morphology/undecided_runs.h"

namespace lamella {

/// The same as ThinFeatureStream, and far quicker where slack is as large as the radius or larger, and most
/// is thick enough: a center where the ball fits then excuses much about it. Places are looked for run by run
/// where none is known near by, and only what is left open is held against all of them in the end.
class ThinFeatureSearch {
  public:
    ThinFeatureSearch(const LayerLattice& lattice, const Thinness& thinness,
                      FeatureKind medium = FeatureKind::wall);
    void push(const RunRows& layer);
    void finish() { push_beyond(); }
    bool pop(RunRows& out);

  private:
    /// A layer with the margin's lines.
    struct Slab {
        RunRows of, beside;             // what is measured, and what lies beside it
        UndecidedRuns open;             // not known to lie near a center
        std::vector<NumberedRun> left;  // runs of which something is open, in their order
        BallCentersByRun centers;       // known: where in `of` a ball's middle may be
    };

    bool is_kept(std::size_t index) const { return index - first_ < slabs_.size(); }
    Slab& slab(std::size_t index) { return slabs_[index - first_]; }
    void push_beyond();
    void push_slab(RunRows solid, bool is_judged);
    void find_centers(std::size_t index);
    void inherit_from(std::size_t index, const NumberedRun& run, std::size_t other, std::size_t other_line);
    void decide_within(const BallCenter& center, std::size_t index, const NumberedRun& run);
    std::span<const Run> search(std::size_t index, const NumberedRun& run);
    void look_near(std::size_t index, std::span<const NumberedRun> runs, RunDifference& left);
    void thin_of(std::size_t index, RunRows& out);

    FeatureKind medium_;
    std::size_t lines_, margin_;  // of the lattice, and beside it on either side
    BallLines fitting_, near_;    // the ball that is to fit, and the one that excuses what is near
    BallFootprint footprint_;     // what near_ reaches
    std::size_t beyond_;          // empty layers before the first and behind the last
    DilatedDifference remainder_;
    std::vector<const RunRows*> beside_;  // of the layers about the one searched

    std::deque<Slab> slabs_;
    BallCenters centers_;
    std::size_t first_ = 0;    // index of the first that is kept
    std::size_t found_ = 0;    // how many were searched for the centers that they need
    std::size_t next_;         // to come out
    std::size_t to_come_ = 0;  // layers that went in and did not come out yet
};

}  // namespace lamella
