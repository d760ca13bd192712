// The way back into a job of GRBL: whatever line it was left at, its modes are the same again.
#include "printers/serial/grbl_modes.h"

#include <catch2/catch.hpp>

namespace grbl_modes_test {

using namespace lamella;

namespace {

GrblModes after(const std::vector<std::string>& lines, GrblModes modes = {}) {
    for (const std::string& line : lines) modes.apply(line);
    return modes;
}

}  // namespace

TEST_CASE("a raster job is taken up where it was, with the beam off on the way and on at last") {
    const GrblModes modes = after({"G21", "G90", "M4S0", "G0X10Y20", "G1X12S250F1800", "X13.5S90"});
    CHECK(modes.take_up() == std::vector<std::string>{"M5", "G21", "G90", "G94", "G17", "G54", "G0 X13.5 Y20",
                                                      "F1800", "G21", "G90", "G94", "G1", "M4 S90"});
}

TEST_CASE("relative moves, inches and a board's own offset are followed") {
    const GrblModes modes = after({"G20G91G55", "G1 X1 F10", "X-.5 Y2"});
    CHECK(modes.take_up() == std::vector<std::string>{"M5", "G21", "G90", "G94", "G17", "G55",
                                                      "G0 X12.7 Y50.8", "F254", "G20", "G91", "G94", "G1"});
}

TEST_CASE("left after any line and taken up, a job's modes are what they were") {
    const std::vector<std::string> job{"G21G90",    "G17",    "M8", "M3 S100", "G0 X5 Y5",   "G1 X10 F600",
                                       "Y20",       "G91",    "X1", "G90",     "G2X1Y1I2J0", "G20",
                                       "G1 X1 F20", "G21",    "M5", "M9",      "G0X0Y0",     "G56",
                                       "M4",        "G1X3S7", "G93"};
    for (std::size_t cut = 0; cut <= job.size(); ++cut) {
        const GrblModes left = after({job.begin(), job.begin() + static_cast<std::ptrdiff_t>(cut)});
        const GrblModes again = after(GrblModes::from_json(left.to_json()).take_up());
        INFO("behind line " << cut);
        auto was = left.to_json(), is = again.to_json();
        for (const char* name :
             {"x", "y", "units", "distance", "feed_mode", "plane", "offset", "beam", "coolant"})
            CHECK(was.at(name) == is.at(name));
        CHECK(is.at("feed").get<double>() == Approx(was.at("feed").get<double>()));
        if (was.at("beam") != 5) CHECK(was.at("power") == is.at("power"));
    }
}

TEST_CASE("a journal with numbers that no machine has is damaged") {
    const auto good = GrblModes().to_json();
    for (const char* name : {"motion", "plane", "units", "x", "feed"}) {
        auto bad = good;
        bad[name] = 1e300;
        CHECK_THROWS_AS(GrblModes::from_json(bad), nlohmann::json::exception);
    }
    auto between = good;
    between["motion"] = 1.5;
    CHECK_THROWS_AS(GrblModes::from_json(between), nlohmann::json::exception);
}

TEST_CASE("a job that cannot be followed says why") {
    CHECK(after({"G1X1", "G0Z5"}).obstacle().find("in z") != std::string::npos);
    CHECK(after({"G92X0Y0", "G1X1"}).obstacle().find("offsets") != std::string::npos);
    CHECK(after({"G28"}).obstacle().find("coordinates") != std::string::npos);
    CHECK(after({"$H", "G1X1Y2S3", "M2"}).obstacle().empty());
}

TEST_CASE("cuts take their time, and fast moves none that is known") {
    GrblModes modes;
    CHECK(modes.apply("G0X30Y40") == 0);
    CHECK(modes.apply("G1X0Y0F600") == Approx(5));
    CHECK(modes.apply("X10") == Approx(1));
}

}  // namespace grbl_modes_test
