// Intervals of a line in which a cosine wave lies between two levels, in closed form and without the arc
// functions of the C library.
#pragma once

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
    int count = 0;
};
WaveRuns wave_runs(const Wave& wave, Interval levels);

/// Appends the intervals (mm, ascending) of a line in which the wave lies between the levels, clipped to
/// `clip` (finite). The wave has angle 0 at `origin`, mm.
void append_wave_runs(const WaveRuns& runs, double origin, double period, Interval clip,
                      std::vector<Interval>& out);

}  // namespace lamella
