// G-code for lasers: what is cut, with what power, and that the beam is off between cuts.
#include "printers/gcode/laser_gcode.h"

#include <catch2/catch.hpp>
#include <set>

#include "engine/base/error.h"
#include "printers/gcode/gcode.h"
#include "tests/printers/common/plane_solids.h"
#include "tests/printers/gcode/gcode_lines.h"
#include "tests/printers/toolpath/supported_table.h"

namespace laser_gcode_test {

using namespace lamella;
using namespace lamella::test;

namespace {

PrinterProfile laser() {
    PrinterProfile profile;
    profile.gcode.flavour = Flavour::grbl;
    profile.vector.tolerance = 0.01;
    return profile;
}

/// A plate of 30 x 20 mm with a round hole of 4 mm radius; the third of its four layers is empty.
Job plate() {
    return make_job(
        {{10, 10, 0}, {40, 30, 12}},
        [](double z) {
            return z > 6 && z < 9 ? std::vector<Figure>()
                                  : std::vector<Figure>{rectangle({10, 10}, {40, 30})};
        },
        3,
        [](double) {
            return std::vector<Figure>{disc({20, 20}, 4)};
        });
}

std::string cut(const Job& job, const PrinterProfile& profile, LayerRange range) {
    const TemporaryFolder folder;
    run_layers(job, *make_gcode(profile, folder / "out", false), range);
    return read_text(folder / "out");
}

/// Length under the beam in a layer.
double cut_length(const std::vector<PlaneMove>& moves, int layer) {
    double sum = 0;
    for (const PlaneMove& move : moves) sum += move.layer == layer && move.power > 0 ? move.length : 0;
    return sum;
}

}  // namespace

TEST_CASE("lasers cut the outlines, half the kerf beside them", "[gcode][laser]") {
    PrinterProfile profile = laser();
    profile.cutting.kerf = 0.4;
    profile.gcode.arcs = GENERATE(false, true);
    const std::string text = cut(plate(), profile, {0, 4});
    const auto moves = plane_moves(text);
    // Round corners outside, a smaller circle inside.
    const double outline = 2 * (30 + 20) + 2 * pi * 0.2, hole = 2 * pi * (4 - 0.2);
    for (const int layer : {0, 1, 3})
        CHECK(cut_length(moves, layer) == Approx(outline + hole).epsilon(0.002));
    CHECK(cut_length(moves, 2) == 0);
    CHECK(gcode_fact(text, "length cut [mm]") == Approx(3 * (outline + hole)).epsilon(0.002));
    CHECK(gcode_fact(text, "sheets") == 3);
    Rect reached;
    for (const PlaneMove& move : moves) reached = unite(reached, Rect{move.to, move.to});
    CHECK(reached.lo.x == 0);
    CHECK(reached.lo.y == 0);
    CHECK(reached.hi.x == Approx(30.4).margin(0.02));
    CHECK(reached.hi.y == Approx(20.4).margin(0.02));
}

TEST_CASE("the beam is on along cuts alone, and everything is what GRBL knows", "[gcode][laser]") {
    PrinterProfile profile = laser();
    profile.laser.cut_power = 0.85;
    profile.laser.power_steps = 255;
    profile.laser.cut_speed = 12;
    profile.laser.dynamic_power = GENERATE(true, false);
    const std::string text = cut(plate(), profile, {0, 4});
    const std::set<std::string> known{"",    "G0",  "G1", "G2", "G3", "G17", "G21",
                                      "G90", "G94", "M0", "M2", "M3", "M4",  "M5"};
    int pauses = 0, on = 0;
    bool beam = false;
    for (const GcodeLine& line : gcode_lines(text)) {
        INFO(line.text);
        CHECK(line.text.size() <= 79);
        CHECK(known.contains(line.command));
        CHECK_FALSE((line.has('E') || line.has('Z')));
        pauses += line.command == "M0";
        if (line.command == "M3" || line.command == "M4") {
            ++on;
            beam = true;
            CHECK(line.command == (profile.laser.dynamic_power ? "M4" : "M3"));
            CHECK(line.words.at('S') == 0);
        }
        if (line.command == "M5") beam = false;
        if (line.command == "M0") CHECK_FALSE(beam);
        if (line.command == "G0" && beam) CHECK(line.words.at('S') == 0);
        if (line.command == "G0") CHECK_FALSE(line.has('F'));
        if (line.command == "G1") CHECK(beam);
    }
    CHECK(on == 3);
    CHECK(pauses == 2);  // between three sheets
    CHECK_FALSE(beam);
    for (const PlaneMove& move : plane_moves(text)) {
        if (move.command != "G1") continue;
        CHECK(move.power == 217);  // 0.85 * 255, rounded
        CHECK(move.speed == Approx(12));
    }
}

TEST_CASE("cuts are repeated and numbers engraved with their own power", "[gcode][laser]") {
    PrinterProfile profile = laser();
    const double once = cut_length(plane_moves(cut(plate(), profile, {0, 1})), 0);
    profile.laser.cut_passes = 3;
    CHECK(cut_length(plane_moves(cut(plate(), profile, {0, 1})), 0) == Approx(3 * once));
    profile.cutting.numbers = true;
    double engraved = 0;
    bool cutting = false;
    for (const PlaneMove& move : plane_moves(cut(plate(), profile, {0, 1}))) {
        if (move.command == "G0") continue;
        cutting = cutting || move.power == 1000;
        if (move.power == 300) {
            CHECK(move.speed == Approx(50));
            CHECK_FALSE(cutting);  // a number is engraved before its piece is cut free
            engraved += move.length;
        } else {
            CHECK(move.power == 1000);
        }
    }
    CHECK(engraved > 3);
}

TEST_CASE("the machine's rate of lines holds for lasers", "[gcode][laser][rate]") {
    PrinterProfile profile = laser();
    profile.laser.cut_speed = 100;
    profile.vector.tolerance = 0.001;
    CHECK(gcode_fact(cut(plate(), profile, {0, 2}), "worst segment rate [lines/s]") > 60);
    profile.gcode.lines_per_second = 50;
    const std::string text = cut(plate(), profile, {0, 2});
    CHECK(gcode_fact(text, "worst segment rate [lines/s]") <= 50 * 1.0001);
    CHECK(gcode_fact(text, "slowed for the segment rate [mm]") > 0);
}

TEST_CASE("laser jobs that were stopped are continued byte for byte", "[gcode][laser]") {
    const TemporaryFolder folder;
    const int stop = GENERATE(0, 1, 3);
    run_layers(plate(), *make_gcode(laser(), folder / "parts", false), {0, 4}, false, stop);
    run_layers(plate(), *make_gcode(laser(), folder / "parts", false), {0, 4}, true);
    CHECK(read_text(folder / "parts") == cut(plate(), laser(), {0, 4}));
}

TEST_CASE("what a laser cannot do is refused", "[gcode][laser]") {
    const TemporaryFolder folder;
    const auto begin = [&](auto change, const Job& job) {
        PrinterProfile profile = laser();
        change(profile);
        make_gcode(profile, folder / "out", false)->open(job, {0, 1}, false);
    };
    const auto nothing = [](PrinterProfile&) {};
    CHECK_THROWS_WITH(begin(nothing, supported_table()), Catch::Contains("prints no supports"));
    CHECK_THROWS_WITH(begin(
                          [](PrinterProfile& p) {
                              p.cutting.sheet = {{300, 200}};
                          },
                          plate()),
                      Catch::Contains("printer.sheet"));
    CHECK_THROWS_WITH(begin([](PrinterProfile& p) { p.filament.bed_x = 29.9; }, plate()),
                      Catch::Contains("30.000 x 20.000") && Catch::Contains("29.900"));
    CHECK_THROWS_WITH(begin([](PrinterProfile& p) { p.laser.cut_power = 1.5; }, plate()),
                      Catch::Contains("cut_power"));
    CHECK_THROWS_WITH(begin([](PrinterProfile& p) { p.gcode.start_script = std::string(80, 'x'); }, plate()),
                      Catch::Contains("start_script, line 1"));
    CHECK_NOTHROW(begin(nothing, plate()));
}

}  // namespace laser_gcode_test
