// The time of each line of a job, against closed forms of motion with limited acceleration.
#include "printers/serial/motion_timer.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <numeric>

#include "engine/base/error.h"
#include "printers/serial/print_chunk.h"

namespace motion_timer_test {

using namespace lamella;

namespace {

std::vector<double> times(const std::string& text, Dialect dialect = Dialect::marlin,
                          MotionLimits limits = {}) {
    ChunkMaker maker(dialect, limits);
    std::vector<double> seconds;
    for (const LineFacts& line : maker.clean(text).facts)
        seconds.push_back(static_cast<double>(line.seconds));
    return seconds;
}

double total(const std::string& text, Dialect dialect = Dialect::marlin) {
    const auto seconds = times(text, dialect);
    return std::accumulate(seconds.begin(), seconds.end(), 0.0);
}

}  // namespace

TEST_CASE("a move from standstill to standstill takes its way at speed and one ramp more") {
    // 100 mm at 100 mm/s with 1000 mm/s^2: two ramps of 0.1 s cost 0.1 s.
    CHECK(times("G90\nG1 X100 F6000\n")[0] == 0);
    CHECK(times("G90\nG1 X100 F6000\n")[1] == Approx(1.1));
    // 0.4 mm never reach it: 2 sqrt(s / a).
    CHECK(times("G1 X0.4 F6000\n")[0] == Approx(2 * std::sqrt(0.4 / 1000)));
    CHECK(times("G1 X0.4 F6000\n", Dialect::marlin, {4000, 4000, 0.013, 50})[0] ==
          Approx(2 * std::sqrt(0.4 / 4000)));
}

TEST_CASE("a straight line in pieces takes as long as in one, and a corner costs time") {
    std::string pieces;
    for (int i = 1; i <= 100; ++i) pieces += "G1 X" + std::to_string(i) + " F6000\n";
    CHECK(total(pieces) == Approx(1.1).epsilon(1e-4));
    CHECK(total("G1 X50 F6000\nG1 X0\n") == Approx(2 * 0.6));
    const double corner = total("G1 X50 F6000\nG1 Y50\n");
    CHECK(corner > 1.1);
    CHECK(corner < 1.2);
}

TEST_CASE("a circle takes its circumference") {
    // 20 mm of radius at 20 mm/s: 2 pi s and a ramp of 20 ms.
    CHECK(total("G1 X20 F1200\nG2 X20 Y0 I-20 J0\n") - total("G1 X20 F1200\n") ==
          Approx(2 * std::numbers::pi).epsilon(0.01));
    CHECK(total("G21\nG90\nG0X20\nG3X20Y0I-20F1200\n", Dialect::grbl) -
              total("G21\nG90\nG0X20\n", Dialect::grbl) ==
          Approx(2 * std::numbers::pi).epsilon(0.01));
    // Half a circle by its radius, either way round, and in steps of a quarter.
    for (const char* word : {"G2", "G3"}) {
        INFO(word);
        CHECK(total(std::string(word) + " X40 Y0 R20 F1200\n") == Approx(std::numbers::pi).epsilon(0.02));
    }
}

TEST_CASE("heating, homing and waits take no time that could be told, dwells take theirs") {
    CHECK(total("M140 S60\nM104 S210\nG28\nG29\nM190 S60\nM109 S210\nM0\nM600\nM400\nM106 S255\n") == 0);
    CHECK(times("G4 S2\nG4 P500\n") == std::vector<double>{2, 0.5});
    CHECK(times("G4 P1.5\nM0\n$H\n", Dialect::grbl) == std::vector<double>{1.5, 0, 0});
    // The nozzle stands while it is heated.
    CHECK(total("G1 X50 F6000\nM109 S210\nG1 X100\n") == Approx(1.2));
    CHECK(total("G1 X50 F6000\nM106 S9\nG1 X100\n") == Approx(1.1));
}

TEST_CASE("accelerations that the job sets are followed") {
    CHECK(total("M204 S4000\nG1 X100 F6000\n") == Approx(1.025));
    CHECK(total("M204 P1000 T4000\nM83\nG1 X100 F6000\n") == Approx(1.025));
    CHECK(total("M204 P1000 T4000\nM83\nG1 X100 E5 F6000\n") == Approx(1.1));
}

TEST_CASE("a filament that is drawn back, a lift and a move into nowhere are timed each by its own way") {
    CHECK(total("M83\nG1 E-2 F1800\n") == Approx(2.0 / 30 + 0.03));
    CHECK(total("G0 Z10 F600\n") == Approx(1.01));
    CHECK(total("G1 X0 Y0 F600\nG92 X50\nG1 X50\n") == 0);
}

TEST_CASE("GRBL: lines without a G word go on, fast moves take the rapid speed, inches are inches") {
    CHECK(total("G21G90G1F600\nX10\nX20\n", Dialect::grbl) == Approx(2.01));
    CHECK(total("G0X50\n", Dialect::grbl) == Approx(1.05));
    CHECK(total("G20G91G1F60\nX1\n", Dialect::grbl) == Approx(1 + 0.0254));
}

TEST_CASE("a line that cannot be sent is told by its number in the whole text") {
    ChunkMaker maker(Dialect::marlin);
    maker.clean("; comment\nG28\n\nG1 X1\n");
    CHECK_THROWS_WITH(maker.clean("G1 X2\n@pause\n"), Catch::Contains("line 6: \"@pause\""));
    ChunkMaker skipping(Dialect::grbl);
    skipping.skip("; comment\nG28\n\nG1 X1\n");
    const CleanText clean = skipping.clean(";\nG1 X2\n");
    REQUIRE(clean.facts.size() == 1);
    CHECK(clean.facts[0].source == 6);
    CHECK_THROWS_WITH(skipping.clean("G0 X1 ! Y1\n"),
                      Catch::Contains("line 7: ") && Catch::Contains("holds !"));
}

TEST_CASE("a move beyond every machine is refused with its line") {
    for (const Dialect dialect : {Dialect::marlin, Dialect::grbl}) {
        ChunkMaker maker(dialect);
        CHECK_THROWS_WITH(maker.clean("G1 X1 F600\nG1 X1000000000000\n"),
                          Catch::Contains("line 2: ") && Catch::Contains("where no machine is"));
    }
}

}  // namespace motion_timer_test
