// What is left of layers when a ball about each point of others is taken away: as when those are grown first,
// at the cost of what is left. Quick for balls that reach few lines, and where little is left.
#pragma once

#include <deque>
#include <span>
#include <vector>

#include "engine/morphology/run_difference.h"

namespace lamella {

/// What of `a` is left when a disc of `radius` about each point of `b`, rows of equal number, is taken away.
void subtract_dilated(const RunRows& a, const RunRows& b, double radius, double row_pitch, RunRows& out);

/// The lines that a ball reaches from the middle one, and how far along each; the nearest first.
class BallLines {
  public:
    struct Line {
        int layer, row;  ///< from the middle one
        RoundedExtent reach;
    };
    BallLines(const LayerLattice& lattice, double radius);
    const std::vector<Line>& lines() const { return lines_; }
    /// How many layers and rows it reaches to either side.
    int layers() const { return layers_; }
    int rows() const { return rows_; }

  private:
    int layers_, rows_;
    std::vector<Line> lines_;
};

/// The rows of layers about one, from as many below it as a ball reaches to as many above; null where there
/// is none.
using LayersAbout = std::span<const RunRows* const>;

/// What of single runs of the middle layer is left when a ball about each point of layers is taken away.
class DilatedDifference {
  public:
    /// What is left of a run of that line; valid until the next call.
    std::span<const Run> difference(const Run& run, std::size_t line, LayersAbout taken,
                                    const BallLines& ball);

  private:
    RunDifference left_;
};

/// The same of layers that stream by, with balls that reach from layer to layer. What lies beside the lines
/// and layers given takes nothing away. Layers come out in the order in which they went in, once all are
/// known that reach them.
class DilatedDifferenceStream {
  public:
    DilatedDifferenceStream(const LayerLattice& lattice, double radius)
        : ball_(lattice, radius), reach_(lattice.layers_within(radius)) {}

    /// Adds the next layer of what something is taken from, and of what is grown and taken: rows of equal
    /// number.
    void push(RunRows from, RunRows taken);
    /// No more layers will come.
    void finish() { finished_ = true; }
    /// Takes the next layer. False where further ones have to be pushed first, or there are no more.
    bool pop(RunRows& out);

  private:
    struct Pair {
        RunRows from, taken;
    };
    BallLines ball_;
    std::size_t reach_;  // layers
    bool finished_ = false;
    std::deque<Pair> layers_;  // those that may still reach, and those to come out
    std::size_t past_ = 0;     // how many of them came out
};

}  // namespace lamella
