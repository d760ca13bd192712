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

/// Computes the same as ThinFeatureStream. It is far quicker if the slack is at least as large as the radius
/// and most of the medium is thick enough: one ball centre then decides many points around it. Ball centres
/// are searched for run by run, and only where none is known nearby. In the end the points that are still
/// undecided are tested against all ball centres.
class ThinFeatureSearch {
  public:
    ThinFeatureSearch(const LayerLattice& lattice, const Thinness& thinness,
                      FeatureKind kind = FeatureKind::wall);
    void push(const RunRows& layer);
    void finish() { push_beyond(); }
    bool pop(RunRows& out);

  private:
    /// A layer, with the margin's lines.
    struct Slab {
        RunRows of, beside;  // the measured medium and its complement
        UndecidedRuns open;  // the part of each run of `of` not within reach of a known ball centre
        std::vector<NumberedRun> left;  // runs with an undecided part, in order
        BallCentersByRun centers;       // the ball centres found in `of` so far
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

    FeatureKind kind_;
    std::size_t lines_, margin_;  // lines of the lattice, and extra ones on either side
    BallLines fitting_, near_;    // balls of `radius`, which must fit, and of `radius` + `slack`
    BallFootprint footprint_;     // of near_
    std::size_t beyond_;          // empty layers added below the first and above the last
    DilatedDifference remainder_;
    std::vector<const RunRows*> beside_;  // complements of the layers around the searched one

    std::deque<Slab> slabs_;
    BallCenters centers_;
    std::size_t first_ = 0;    // index of slabs_.front()
    std::size_t found_ = 0;    // index of the next layer that find_centers() handles
    std::size_t next_;         // index of the next layer to come out
    std::size_t to_come_ = 0;  // layers that went in and have not come out yet
};

}  // namespace lamella
