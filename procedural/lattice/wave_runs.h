// Intervals of a line in which a cosine wave lies between two levels, in closed form and without the arc
// functions of the C library.
#pragma once

#include <span>
#include <vector>

#include "engine/base/geometry.h"
#include "procedural/lattice/tpms_surface.h"

namespace lamella {

/// Returns the angle, in turns from -1/2 to 1/2, of the point (cosine, sine) of the unit circle, accurate to
/// 1e-16 turns.
double turns_of(double cosine, double sine);

/// The turns t, within one period, in which a wave lies strictly between two levels: up to two intervals,
/// ascending, disjoint, within [-1, 3/2]; one infinite interval if the wave is always between them.
struct WaveRuns {
    Interval part[2];
    std::size_t count = 0;
    std::span<const Interval> parts() const { return {part, count}; }
};
WaveRuns wave_runs(const Wave& wave, Interval levels);

/// Appends the intervals (mm, ascending) of a line, clipped to `clip` (finite), that repeat those of one
/// period: `parts` in turns, ascending, within [-1, 3/2], or one infinite interval. Turn 0 lies at `origin`,
/// mm.
void append_periodic_runs(std::span<const Interval> parts, double origin, double period, Interval clip,
                          std::vector<Interval>& out);

}  // namespace lamella
