// GrownLine: one line of a dexel solid grown by balls, by looking at every run about it.
#pragma once

#include <span>
#include <vector>

#include "engine/ball_rows.h"
#include "engine/run_union.h"

namespace lamella {

/// Grows lines one by one, by brute force: the cost of a line is that of all runs that a ball reaches. For
/// small balls that is less than it takes to find out which of them make no difference (GrownBlock).
class GrownLine {
  public:
    /// `most_weight` bounds the weights of all runs. What is grown is clipped to `extent`.
    GrownLine(const LayerLattice& lattice, double most_weight, Run extent);

    /// Appends the runs of a grown line of a stack of layers, sorted, disjoint and not touching.
    void grow(std::span<const BallRows* const> layers, std::size_t layer, std::size_t line,
              std::vector<Run>& out);

  private:
    /// What the greatest ball reaches of a layer; the lines from its middle on.
    struct Disc {
        double up;                       // square of the layer's distance
        std::vector<double> across;      // of each line's
        std::vector<BallReach> reaches;  // on it
    };
    void add(const BallRows& layer, std::size_t line, const Disc& disc);

    double most_weight_;
    std::vector<Disc> discs_;  // from its own layer on
    RunUnion union_;
};

}  // namespace lamella
