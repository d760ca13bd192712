// Dilation and erosion of a stream of layers by a ball: exact morphology of dexel solids.
#pragma once

#include <deque>
#include <span>
#include <vector>

#include "engine/morphology/ball_extents.h"
#include "engine/morphology/power_cell_pruner.h"

namespace lamella {

/// The rows of one layer, grown by a disc about each of their points. Ends are rounded to the nearest unit;
/// the rest is exact. Lines beyond the first and the last are not made.
void grow_rows(const WeightedRows& rows, double row_pitch, RunRows& out);
/// What is left when a disc about each point of the void is taken away; beyond the lines all is void.
void shrink_rows(const RunRows& rows, double radius, double row_pitch, RunRows& out);

/// Grows layers by a ball about each of their points, exactly (thesis 3.2; Chen, Panozzo and Dumas 2018), in
/// blocks of lines: by all runs about them where balls are small (BruteForceDilation), else by those that can
/// make a difference (PrunedDilation). Layers come out in the order in which they went in, once all are known
/// that reach them: what is held depends on the ball's height alone. Independent blocks are worked on in
/// parallel.
class DilationStream {
  public:
    /// `max_reach` bounds the radius of all runs, run units.
    DilationStream(const LayerLattice& lattice, double max_reach);

    /// Adds the next layer. Throws FaultError where it has other lines than the lattice, or a larger ball.
    void push(WeightedRows layer);
    /// No more layers will come.
    void finish() { finished_ = true; }
    /// Takes the next grown layer. False where further layers have to be pushed first, or there are no more.
    bool pop(RunRows& out);

  private:
    void finish_block();
    void limit_sights();

    LayerLattice lattice_;
    double max_weight_;     // of a run
    BallExtentTable ball_;  // of max_reach
    std::size_t reach_;     // layers that a ball reaches up
    std::size_t block_;     // layers that are finished together
    bool finished_ = false;
    std::deque<WeightedRows> layers_;  // those that may still be reached from or are to be finished
    std::size_t past_ = 0;             // how many of them are finished
    PowerCellPruner sight_limits_;
    std::size_t limited_ = 0;     // how many of the layers have limited each other's sights
    bool few_ends_left_ = false;  // by growing, the last time: then it is not worth the while
    std::deque<RunRows> done_;
};

/// The same for what is left when a ball about each point of the void is taken away. Beyond the lattice all
/// is void.
class ErosionStream {
  public:
    ErosionStream(const LayerLattice& lattice, double radius);
    void push(const RunRows& layer);
    void finish();
    bool pop(RunRows& out);

  private:
    void push_void();

    LayerLattice lattice_;
    double radius_;
    std::size_t margin_;       // lines of void beside the lattice
    std::size_t void_layers_;  // before the first layer and behind the last
    std::size_t to_drop_;      // of those before the first
    std::size_t to_come_ = 0;  // layers that went in and did not come out yet
    DilationStream voids_;
};

}  // namespace lamella
