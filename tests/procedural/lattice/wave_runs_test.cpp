// Angles and runs of waves against the library's arc functions.
#include "procedural/lattice/wave_runs.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

namespace wave_runs_test {

using namespace lamella;

namespace {}

TEST_CASE("an angle in turns is the arc tangent of its sine and cosine", "[wave_runs]") {
    for (int i = -5000; i <= 5000; ++i) {
        const double angle = i * (pi / 5000);
        const double c = std::cos(angle), s = std::sin(angle);
        INFO("angle " << angle);
        REQUIRE(turns_of(c, s) == Approx(std::atan2(s, c) / (2 * pi)).margin(2e-16).epsilon(2e-15));
    }
    CHECK(turns_of(1, 0) == 0);
    CHECK(turns_of(-1, 0) == 0.5);
    CHECK(turns_of(0, 1) == 0.25);
    CHECK(turns_of(0, -1) == -0.25);
}

TEST_CASE("a wave lies between its levels on its runs and nowhere else", "[wave_runs]") {
    std::mt19937 random(8);
    std::uniform_real_distribution<double> number(-2, 2), narrow(0.01, 1.5);
    for (int round = 0; round < 3000; ++round) {
        const Wave wave{number(random), round % 5 == 0 ? 0 : number(random), number(random)};
        const double middle = number(random), half = narrow(random);
        const Interval levels{round % 3 == 0 ? -infinity : middle - half, middle + half};
        const double period = narrow(random), origin = number(random);
        const Interval clip{-3.1, 4.2};
        std::vector<Interval> intervals;
        append_periodic_runs(wave_runs(wave, levels).parts(), origin, period, clip, intervals);
        for (std::size_t i = 1; i < intervals.size(); ++i) REQUIRE(intervals[i - 1].hi <= intervals[i].lo);
        for (int k = 0; k < 200; ++k) {
            const double p = clip.lo + clip.width() * k / 199, angle = (p - origin) * 2 * pi / period;
            const double g = wave.sine * std::sin(angle) + wave.cosine * std::cos(angle) + wave.constant;
            if (std::min(std::abs(g - levels.lo), std::abs(g - levels.hi)) < 1e-12) continue;
            bool in = false;
            for (const Interval& interval : intervals) in |= interval.contains(p);
            REQUIRE(in == (levels.lo < g && g < levels.hi));
        }
    }
}

TEST_CASE("a flat wave is between its levels everywhere or nowhere", "[wave_runs]") {
    CHECK(wave_runs({0, 0, 0.5}, {0, 1}).count == 1);
    CHECK(wave_runs({0, 0, 1.5}, {0, 1}).count == 0);
    CHECK(wave_runs({0, 0, 1}, {0, 1}).count == 0);
    std::vector<Interval> intervals;
    append_periodic_runs(wave_runs({0, 0, 0.5}, {0, 1}).parts(), 0, 1, {2, 5}, intervals);
    REQUIRE(intervals.size() == 1);
    CHECK(intervals[0].lo == 2);
    CHECK(intervals[0].hi == 5);
}

}  // namespace wave_runs_test
