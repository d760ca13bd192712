// Dilation and erosion of a stream of layers by a ball: exact morphology of dexel solids.
#pragma once

#include <deque>
#include <span>
#include <vector>

#include "engine/morphology/ball_extents.h"
#include "engine/morphology/power_cell_pruner.h"

namespace lamella {

/// Dilates one layer by a disc about each point, whose radius may differ from run to run. Exact but for
/// rounding run ends to the nearest unit. `out` has the same lines as `rows`: what grows beyond the first or
/// last line is dropped. `row_pitch` in run units.
void grow_rows(const WeightedRows& rows, double row_pitch, RunRows& out);
/// Erodes one layer by a disc: dilates the void and returns the complement. Outside the lines all is void.
/// `radius` and `row_pitch` in run units.
void shrink_rows(const RunRows& rows, double radius, double row_pitch, RunRows& out);

/// Exact dilation of a stream of layers by a ball about each point (thesis 3.2; Chen, Panozzo and Dumas
/// 2018).
///
///     const double radius = 5 * run_unit;  // 5 pixels
///     DilationStream dilation({.row_pitch = run_unit, .layer_pitch = run_unit, .lines = 100}, radius);
///     RunRows dilated;
///     while (next_layer(rows)) {  // rows: a RunRows of 100 lines
///         dilation.push(WeightedRows(rows, radius));
///         while (dilation.pop(dilated)) use(dilated);
///     }
///     dilation.finish();
///     while (dilation.pop(dilated)) use(dilated);
///
/// Works on blocks of lines, independent ones in parallel. Small balls are dilated from all runs within reach
/// (BruteForceDilation), larger ones from the runs that can be visible (PrunedDilation). Layers come out in
/// the order in which they were pushed, each as soon as all layers within reach of it are known. The number
/// of layers held depends on the ball's height alone. As many layers come out as went in: what grows beyond
/// them, or beyond the lattice's lines, is dropped.
class DilationStream {
  public:
    /// `max_reach` is an upper bound of the radius of all runs, run units.
    DilationStream(const LayerLattice& lattice, double max_reach);

    /// Adds the next layer. Throws FaultError when its number of lines is not that of the lattice, or when a
    /// ball is larger than `max_reach`.
    void push(WeightedRows layer);
    /// Declares that no more layers follow.
    void finish() { finished_ = true; }
    /// Returns true and fills `out` with the next dilated layer; false if more layers must be pushed first,
    /// or all have come out.
    bool pop(RunRows& out);

  private:
    void finish_block();
    void limit_sights();

    LayerLattice lattice_;
    double max_weight_;     // squared max_reach
    BallExtentTable ball_;  // of radius max_reach
    std::size_t reach_;     // layers that a ball reaches up
    std::size_t block_;     // number of layers dilated together
    bool finished_ = false;
    std::deque<WeightedRows> layers_;  // layers to be dilated, preceded by those that still reach them
    std::size_t past_ = 0;             // how many of layers_ are dilated
    PowerCellPruner sight_limits_;
    std::size_t limited_ = 0;     // how many of layers_ have their power cells bounded
    bool few_ends_left_ = false;  // the last dilation merged most runs: bounding cells would not pay
    std::deque<RunRows> done_;
};

/// Exact erosion of a stream of layers by a ball: the complement of the dilated void. Outside the lattice,
/// and below and above the given layers, all is void. Used like DilationStream.
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
    std::size_t margin_;       // lines of void on either side of the lattice
    std::size_t void_layers_;  // layers of void below the first layer and above the last
    std::size_t to_drop_;      // void layers below the first that have not come out yet
    std::size_t to_come_ = 0;  // layers that went in and have not come out yet
    DilationStream voids_;
};

}  // namespace lamella
