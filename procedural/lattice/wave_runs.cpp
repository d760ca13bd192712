// Angles by a rational estimate and one correction against its sine; then periodic repetition.
#include "procedural/lattice/wave_runs.h"

namespace lamella {
namespace {

constexpr double two_pi = 6.28318530717958647693;

/// Returns the arc cosine in turns, for -1 < k < 1.
double arc_cosine(double k) { return turns_of(k, std::sqrt((1 - k) * (1 + k))); }

}  // namespace

double turns_of(double cosine, double sine) {
    // An estimate within 0.005 radians in the first octant (Rajan et al., IEEE Signal Processing Magazine,
    // 2006).
    const double x = std::abs(cosine), y = std::abs(sine);
    const double q = x < y ? x / y : y / x;
    double guess = q * (two_pi / 8 + 0.273 * (1 - q));
    if (x < y) guess = two_pi / 4 - guess;
    if (cosine < 0) guess = two_pi / 2 - guess;
    if (sine < 0) guess = -guess;
    // The sine of the remaining angle is below 0.005, where three terms of the arc sine are exact.
    const SineCosine g = sine_cosine(guess);
    const double d = sine * g.cosine - cosine * g.sine, d2 = d * d;
    return (guess + d * (1 + d2 * (1.0 / 6 + d2 * (3.0 / 40 + d2 * (15.0 / 336))))) / two_pi;
}

WaveRuns wave_runs(const Wave& wave, Interval levels) {
    const Interval levels_here{levels.lo - wave.constant, levels.hi - wave.constant};
    const double amplitude = wave.amplitude();
    if (!(levels_here.lo < amplitude && -amplitude < levels_here.hi)) return {};
    const bool over_crest = levels_here.hi >= amplitude, under_trough = levels_here.lo <= -amplitude;
    if (over_crest && under_trough) return {{{-infinity, infinity}}, 1};
    const double crest = turns_of(wave.cosine / amplitude, wave.sine / amplitude);
    const double near = over_crest ? 0 : arc_cosine(levels_here.hi / amplitude);
    const double far = under_trough ? 0.5 : arc_cosine(levels_here.lo / amplitude);
    if (over_crest) return {{{crest - far, crest + far}}, 1};
    if (under_trough) return {{{crest + near, crest + (1 - near)}}, 1};
    return {{{crest - far, crest - near}, {crest + near, crest + far}}, 2};
}

void append_periodic_runs(std::span<const Interval> parts, double origin, double period, Interval clip,
                          std::vector<Interval>& out) {
    if (parts.empty() || clip.empty()) return;
    if (parts.front().lo == -infinity) {
        out.push_back(clip);
        return;
    }
    // Intervals lie within [-1, 3/2] turns.
    for (double n = std::floor((clip.lo - origin) / period) - 2;; ++n) {
        for (const Interval& part : parts) {
            const double lo = origin + (part.lo + n) * period;
            const double hi = origin + (part.hi + n) * period;
            if (lo >= clip.hi) return;
            if (hi > clip.lo) out.push_back({std::max(lo, clip.lo), std::min(hi, clip.hi)});
        }
    }
}

}  // namespace lamella
