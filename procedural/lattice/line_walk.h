// walk_lines: finds runs along lines of a function with a known Lipschitz constant, by bisecting intervals
// that are undecided.
#pragma once

#include <span>

#include "engine/runs/runs.h"

namespace lamella {

/// A point of one of several lines; `u` is its coordinate in run units.
struct LinePoint {
    std::size_t line;
    double u;
};

/// A function along each of several lines.
class LineFunction {
  public:
    virtual ~LineFunction() = default;
    /// Computes the values at the points. Each value depends on its point alone.
    virtual void values(std::span<const LinePoint> points, std::span<double> out) const = 0;
    /// Upper bound of the change per run unit along a line.
    virtual double steepest(std::size_t line) const = 0;
    /// Whether the function certainly rises, or falls, all the way from u0 to u1 on a line, u0 < u1.
    virtual bool is_monotone(std::size_t /*line*/, double /*u0*/, double /*u1*/) const { return false; }
};

/// Finds where the function is negative on each of `lines` lines. Appends to `out` one line of runs within
/// [lo, hi) for each. Intervals of 16 pixels are halved until the values at both ends prove that there is no
/// sign change between them, or the function is monotone between them, or down to a quarter pixel. Then sign
/// changes are refined to 1/64 of a run unit.
/// Each step is evaluated on many lines at once. Intervals start at integer multiples of their length, so a
/// run does not depend on where the line begins. NaN is outside.
void walk_lines(const LineFunction& function, std::size_t lines, std::int32_t lo, std::int32_t hi,
                RunRows& out);

}  // namespace lamella
