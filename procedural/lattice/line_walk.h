// The line walk: runs along lines of a function whose steepness is known, by halving what is not proven.
#pragma once

#include <span>

#include "engine/runs/runs.h"

namespace lamella {

/// A point of one of several lines; u is its run coordinate, run units.
struct LinePoint {
    std::size_t line;
    double u;
};

/// A function along each of several lines.
class LineFunction {
  public:
    virtual ~LineFunction() = default;
    /// Its values at the points, as many; each a function of that point alone.
    virtual void values(std::span<const LinePoint> points, std::span<double> out) const = 0;
    /// How much it changes at most per run unit along a line.
    virtual double steepest(std::size_t line) const = 0;
};

/// Finds where the function is below 0 on each of `lines` lines, and appends a line of runs within [lo, hi)
/// to `out` for each. Stretches of 8 pixels are halved until the values at both ends prove that nothing turns
/// between them, or down to a quarter pixel; then turns are narrowed to 1/64 of a run unit. Each such step is
/// made on many lines at once. The stretches lie at whole multiples of their length, so a run does not depend
/// on where the line begins. NaN is outside.
void walk_lines(const LineFunction& function, std::size_t lines, std::int32_t lo, std::int32_t hi,
                RunRows& out);

}  // namespace lamella
