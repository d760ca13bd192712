// DilatedDifference: subtracts the dilation of one stack of layers from another, without building the
// dilation. The cost is that of the difference: quick if the ball reaches few lines, or if little is left.
#pragma once

#include <deque>
#include <span>
#include <vector>

#include "engine/morphology/run_difference.h"

namespace lamella {

/// Computes `a` minus the dilation of `b` by a disc of `radius` (run units, as `row_pitch`). Throws
/// FaultError when `a` and `b` have different numbers of rows.
void subtract_dilated(const RunRows& a, const RunRows& b, double radius, double row_pitch, RunRows& out);

/// The lines that a ball reaches, and its extent along each of them. Sorted by distance from the ball's
/// centre line, nearest first.
class BallLines {
  public:
    struct Line {
        int layer, row;  ///< offset from the centre line
        RoundedExtent reach;
    };
    BallLines(const LayerLattice& lattice, double radius);
    const std::vector<Line>& lines() const { return lines_; }
    /// Returns how many layers the ball reaches up and down.
    int layers() const { return layers_; }
    /// Returns how many rows the ball reaches to either side.
    int rows() const { return rows_; }

  private:
    int layers_, rows_;
    std::vector<Line> lines_;
};

/// The layers around a middle one: BallLines::layers() below it, itself, and as many above. Null where there
/// is no layer.
using LayersAbout = std::span<const RunRows* const>;

/// Difference of single runs and a dilation. Keeps its buffers from call to call.
class DilatedDifference {
  public:
    /// Returns the part of `run`, on line `line` of the middle layer, that lies outside the dilation of
    /// `taken` by the ball. Valid until the next call.
    std::span<const Run> difference(const Run& run, std::size_t line, LayersAbout taken,
                                    const BallLines& ball);

  private:
    RunDifference left_;
};

/// Dilated difference of two streams of layers, by a ball that extends across layers. Outside the given lines
/// and layers nothing is dilated or subtracted. Layers come out in the order in which they were pushed, each
/// as soon as all layers within reach of it are known.
class DilatedDifferenceStream {
  public:
    DilatedDifferenceStream(const LayerLattice& lattice, double radius)
        : ball_(lattice, radius), reach_(lattice.layers_within(radius)) {}

    /// Adds the next layer: the result is `from` minus the dilation of `taken`. Throws FaultError when the
    /// two have different numbers of rows.
    void push(RunRows from, RunRows taken);
    /// Declares that no more layers follow.
    void finish() { finished_ = true; }
    /// Returns true and fills `out` with the next layer; false if more layers must be pushed first, or all
    /// have come out.
    bool pop(RunRows& out);

  private:
    struct Pair {
        RunRows from, taken;
    };
    BallLines ball_;
    std::size_t reach_;  // of the ball to either side, layers
    bool finished_ = false;
    std::deque<Pair> layers_;  // layers that have not come out, preceded by those that still reach them
    std::size_t past_ = 0;     // how many of layers_ have come out
};

}  // namespace lamella
