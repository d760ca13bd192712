// Layers grown or shrunk by a ball while they stream: exact morphology of dexel solids.
#pragma once

#include <deque>
#include <span>
#include <vector>

#include "engine/ball_sweep.h"

namespace lamella {

/// The rows of a layer with the square of the ball's radius at each run.
class BallRows {
  public:
    BallRows() : starts_(1, 0) {}
    /// The same radius everywhere, run units.
    BallRows(const SpanRows& rows, double radius);

    std::size_t lines() const { return starts_.size() - 1; }
    std::span<const BallRun> line(std::size_t l) const {
        return {runs_.data() + starts_[l], starts_[l + 1] - starts_[l]};
    }
    std::span<const BallRun> runs() const { return runs_; }
    void append_line(std::span<const BallRun> runs);

  private:
    std::vector<BallRun> runs_;
    std::vector<std::size_t> starts_;
};

/// The lattice of a stack of layers. Lengths in run units, 1/256 of the pitch along lines; where a ball
/// reaches less far up than across, layers are that much farther apart.
struct LayerLattice {
    double row_pitch = run_unit;    ///< from line to line
    double layer_pitch = run_unit;  ///< from layer to layer
    std::size_t lines = 0;          ///< of each layer

    /// How many lines, or layers, a ball reaches to either side.
    std::size_t lines_within(double reach) const { return static_cast<std::size_t>(reach / row_pitch); }
    std::size_t layers_within(double reach) const { return static_cast<std::size_t>(reach / layer_pitch); }
};

/// The rows of one layer, grown by a disc about each of their points. Ends are rounded to the nearest unit;
/// the rest is exact. Lines beyond the first and the last are not made.
void grow_rows(const BallRows& rows, double row_pitch, SpanRows& out);
/// What is left when a disc about each point of the void is taken away; beyond the lines all is void.
void shrink_rows(const SpanRows& rows, double radius, double row_pitch, SpanRows& out);

/// Grows layers by a ball about each of their points (thesis 3.2; Chen, Panozzo and Dumas 2018). Within each
/// layer runs are carried across the rows with what is left of their reach, and those that cannot be seen any
/// more are dropped; what remains grows from layer to layer. Layers come out in the order in which they went
/// in, once all are known that reach them: what is held depends on the ball's height alone. Independent
/// layers are worked on in parallel.
class GrowingLayers {
  public:
    /// `most_reach` bounds the radius of all runs, run units.
    GrowingLayers(const LayerLattice& lattice, double most_reach);

    /// Adds the next layer, which has as many lines as the lattice says.
    void push(BallRows layer);
    /// No more layers will come.
    void finish() { finished_ = true; }
    /// Takes the next grown layer. False where further layers have to be pushed first, or there are no more.
    bool pop(SpanRows& out);

  private:
    void finish_block();
    Run extent(std::size_t layers) const;

    static constexpr std::size_t block_ = 16;  // layers that are finished together

    LayerLattice lattice_;
    std::size_t reach_;  // layers that a ball reaches up
    bool finished_ = false;
    std::deque<BallRows> layers_;  // those that may still be reached from or are to be finished
    std::size_t past_ = 0;         // how many of them are finished
    std::size_t spread_ = 0;       // how many have been carried across their rows
    std::deque<SpanRows> done_;
};

/// The same for what is left when a ball about each point of the void is taken away. Beyond the lattice all
/// is void.
class ShrinkingLayers {
  public:
    ShrinkingLayers(const LayerLattice& lattice, double radius);
    void push(const SpanRows& layer);
    void finish();
    bool pop(SpanRows& out);

  private:
    void push_void();

    LayerLattice lattice_;
    double radius_;
    std::size_t margin_;       // lines of void beside the lattice
    std::size_t void_layers_;  // before the first layer and behind the last
    std::size_t to_drop_;      // of those before the first
    std::size_t to_come_ = 0;  // layers that went in and did not come out yet
    GrowingLayers voids_;
};

}  // namespace lamella
