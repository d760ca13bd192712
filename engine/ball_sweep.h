// BallSweep: runs that a ball carries from line to line, the core of exact offsets of dexel solids.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/runs.h"

namespace lamella {

/// A solid interval of a line and how far a ball about it reaches.
struct BallRun {
    std::int32_t begin;  ///< as of Run
    std::int32_t end;
    double
        weight;  ///< square of the reach along the line itself, run units^2; what is left of it after steps
    friend bool operator==(const BallRun&, const BallRun&) = default;
};

/// By how many units a reach moves ends of runs when these are rounded to the nearest unit, halves upward.
struct BallReach {
    std::int32_t back, ahead;
    explicit BallReach(double reach) : back(static_cast<std::int32_t>(2 * reach + 1) / 2), ahead(back) {
        if (back - reach == 0.5) --back;
    }
};

/// Goes over parallel lines in one direction and knows at each what lies within reach behind it: a run of
/// weight w, t lines back, covers what lies within R of it, where R^2 = w - (t pitch)^2.
///
/// Only runs that may still be seen are kept: these are half-space power diagrams (Chen, Panozzo and Dumas
/// 2018, thesis 3.2). At a point of the line at distance d from a run, its height R^2 - d^2 falls from line
/// to line, and the more slowly the later the run: where it is below a later one, it stays so. A later and
/// higher run cuts what lies in it out of earlier ones. Of runs beside each other, one is below the left of
/// them up to some point and below the right of them from some point on; where the two parts meet, it is
/// dropped.
class BallSweep {
  public:
    /// `pitch` from line to line, in run units.
    explicit BallSweep(double pitch) : pitch_(pitch) {}

    void reset();
    /// Goes on to the next line.
    void step();
    /// Adds runs that lie on the line itself, sorted by begin; weights are not negative.
    void add(std::span<const BallRun> runs);
    /// Drops what will not be seen any more, as far as its neighbours tell. Done by itself now and then.
    void drop_hidden();

    /// The covered intervals, ends rounded to the nearest unit, in no order; they may overlap.
    void append_covered(std::vector<Run>& out) const;
    /// The runs in reach with what is left of their weights, sorted by begin.
    void append_runs(std::vector<BallRun>& out) const;

  private:
    struct Active {
        double reach, left;  // along the current line, and its square
        double weight;       // at its own line
        std::int32_t begin, end;
        std::int32_t line;
        bool hidden;
    };
    static double below_left(double begin, double end, double gain);
    bool is_hidden(std::size_t i) const;
    static bool before(const Active& a, const Active& b);
    void cut_out(const Active& later, std::size_t& first);

    double pitch_;
    std::int32_t line_ = 0;
    std::size_t kept_ = 0;        // when it was last asked who is hidden
    std::vector<Active> active_;  // sorted by begin
    std::vector<Active> fresh_, merged_;
};

}  // namespace lamella
