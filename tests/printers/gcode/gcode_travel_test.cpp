// Moves without extrusion, read back: inside the part, drawn back, wiped, lifted, and never too many a
// second.
#include <catch2/catch.hpp>

#include "printers/gcode/gcode.h"
#include "printers/gcode/motion_model.h"
#include "tests/printers/common/plane_solids.h"
#include "tests/printers/gcode/gcode_lines.h"

namespace gcode_travel_test {

using namespace lamella;
using namespace lamella::test;

namespace {

constexpr double bed = 220;

/// What happens between one extrusion and the next.
struct Way {
    std::vector<dvec2> points;    ///< where it begins, and where each travel ends
    std::vector<dvec2> wiped;     ///< where each wipe ends
    std::vector<double> heights;  ///< of lifts
    double z = 0;                 ///< of the extrusion after it
    double travel_z = 0;          ///< of its travels
    double drawn = 0, pushed = 0;
    bool changes_layer = false;

    double length() const {
        double sum = 0;
        for (std::size_t i = 1; i < points.size(); ++i) sum += glm::distance(points[i - 1], points[i]);
        return sum;
    }
};

struct Reading {
    std::vector<Way> ways;                  ///< but for the one to the first bead
    std::vector<std::vector<dvec2>> beads;  ///< points extruded through, before each way
    double extruded = 0, all = 0;           ///< sums of E: of moves with X and Y, and of all
};

Reading read(const std::string& text) {
    Reading reading;
    Way way;
    std::vector<dvec2> bead;
    double z = 0;
    dvec2 at{0};
    for (const GcodeLine& line : gcode_lines(text)) {
        if (line.text == ";LAYER_CHANGE") way.changes_layer = true;
        if (line.command != "G0" && line.command != "G1") continue;
        const double e = line.has('E') ? line.words.at('E') : 0;
        reading.all += e;
        if (line.has('Z')) way.heights.push_back(z = line.words.at('Z'));
        if (!line.has('X')) {
            (e < 0 ? way.drawn : way.pushed) += std::abs(e);
            continue;
        }
        const dvec2 to{line.words.at('X'), line.words.at('Y')};
        if (e < 0) {
            way.drawn -= e;
            way.wiped.push_back(to);
        } else if (e == 0) {
            if (way.points.empty()) way.points.push_back(at);
            way.points.push_back(to);
            way.travel_z = z;
        } else {
            reading.extruded += e;
            const bool between = !way.points.empty() || way.drawn > 0;
            way.z = z;
            if (between && !bead.empty()) {
                reading.ways.push_back(way);
                reading.beads.push_back(std::exchange(bead, {}));
            }
            if (bead.empty()) bead.push_back(at);
            bead.push_back(to);
            way = {};
        }
        at = to;
    }
    return reading;
}

std::string print(const Job& job, const PrinterProfile& profile) {
    const TemporaryFolder folder;
    run_layers(job, *make_gcode(profile, folder / "out.gcode", false), {0, job.layers.count()});
    return read_text(folder / "out.gcode");
}

PrinterProfile plain() {
    PrinterProfile profile;
    profile.name = "marlin";
    profile.filament.infill_density = 0.3;
    profile.toolpath.top_layers = profile.toolpath.bottom_layers = 0;
    profile.gcode.prime_line = false;
    return profile;
}

/// Two arms of this length on a bar.
std::vector<Figure> u_shape(double arm) {
    return {rectangle({-15, -15}, {15, -9}), rectangle({-15, -15}, {-9, arm - 15}),
            rectangle({9, -15}, {15, arm - 15})};
}
Job u_part(double arm) {
    return make_job(
        {{-15, -15, 0}, {15, std::max(arm - 15, 15.0), 1}}, [arm](double) { return u_shape(arm); }, 0.2);
}
/// A plate with windows, whose beads lie far apart.
std::vector<Figure> windows() {
    return {disc({-6, -5}, 3.5), disc({6, -5}, 4), disc({0, 6}, 4.5), rectangle({-13, 3}, {-7, 12})};
}
Job windowed() {
    return make_job(
        {{-15, -15, 0}, {15, 15, 1}},
        [](double) {
            return std::vector<Figure>{rectangle({-15, -15}, {15, 15})};
        },
        0.2, [](double) { return windows(); });
}
/// Three columns and a thin one, each an island.
Job columns() {
    return make_job(
        {{-10, -10, 0}, {10, 10, 1}},
        [](double) {
            return std::vector<Figure>{disc({-6, -6}, 3), disc({6, -6}, 3), disc({6, 6}, 3),
                                       disc({-9.3, 9.3}, 0.4)};
        },
        0.2);
}

/// How far the ways within layers come out of the part at most; negative inside. All of the part is one
/// island.
double farthest_out(const Reading& reading, const FigureSlice& part) {
    double farthest = -infinity;
    for (const Way& way : reading.ways) {
        if (way.changes_layer) continue;
        for (std::size_t i = 1; i < way.points.size(); ++i) {
            for (int k = 0; k <= 200; ++k) {
                const dvec2 p = way.points[i - 1] + (way.points[i] - way.points[i - 1]) * (k / 200.0);
                farthest = std::max(farthest, part.value(p - dvec2(bed / 2)));
            }
        }
    }
    return farthest;
}

}  // namespace

TEST_CASE("travels between beads of an island stay inside it, off the outer wall", "[gcode][travel]") {
    const bool ring = GENERATE(false, true);
    const Job job = ring ? windowed() : u_part(12);
    const FigureSlice part(ring ? std::vector<Figure>{rectangle({-15, -15}, {15, 15})} : u_shape(12),
                           ring ? windows() : std::vector<Figure>());
    PrinterProfile profile = plain();
    const std::string text = print(job, profile);
    const Reading inside = read(text);
    CHECK(inside.ways.size() > 40);
    CHECK(farthest_out(inside, part) < -0.15);  // half a line, less what is rounded off
    profile.gcode.travel_inside = false;
    const std::string straight = print(job, profile);
    CHECK(farthest_out(read(straight), part) > 0.5);
    CHECK(read(straight).extruded == Approx(inside.extruded).epsilon(1e-9));
}

TEST_CASE("a detour of more than three times the straight way is not worth it", "[gcode][travel]") {
    const PrinterProfile profile = plain();
    const Reading reading = read(print(u_part(60), profile));
    int across = 0;
    for (const Way& way : reading.ways) {
        if (way.changes_layer || way.points.empty()) continue;
        const double straight = glm::distance(way.points.front(), way.points.back());
        CHECK(way.length() <= 3 * straight + 0.5);
        if (std::abs(way.points.front().x - way.points.back().x) < 18) continue;
        ++across;
        CHECK(way.drawn == Approx(0.8));
    }
    CHECK(across > 0);
}

TEST_CASE("filament is drawn back on ways as long as the profile says", "[gcode][travel]") {
    PrinterProfile profile = plain();
    profile.gcode.retract_from = GENERATE(0.0, 2.0, 12.0);
    profile.gcode.retract_inside_from = GENERATE(0.0, 6.0, 1000.0);
    int wet = 0, dry = 0;
    const auto check = [&](const Reading& reading, bool one_island) {
        for (const Way& way : reading.ways) {
            // Islands of the columns are at least 3 mm apart, ways within them shorter than that.
            const bool inside = one_island || way.length() < 3;
            const bool drawn = way.changes_layer || way.length() > (inside ? profile.gcode.retract_inside_from
                                                                           : profile.gcode.retract_from) +
                                                                       1e-3;
            CAPTURE(way.length(), way.changes_layer);
            CHECK(way.drawn == Approx(drawn ? 0.8 : 0));
            CHECK(way.pushed == way.drawn);
            ++(drawn ? wet : dry);
        }
    };
    check(read(print(windowed(), profile)), true);
    check(read(print(columns(), profile)), false);
    CHECK(wet > 10);
    CHECK((dry > 20) == (profile.gcode.retract_inside_from > 0));
}

TEST_CASE("the nozzle rises on long ways with the filament drawn back, once", "[gcode][travel]") {
    PrinterProfile profile = plain();
    profile.gcode.z_hop = 0.6;
    profile.gcode.z_hop_from = GENERATE(0.0, 8.0);
    const Job job = GENERATE(columns(), windowed());
    const Reading reading = read(print(job, profile));
    int hops = 0;
    double layer_z = 0.2;
    for (const Way& way : reading.ways) {
        CAPTURE(way.length(), way.drawn, way.changes_layer, way.z);
        if (way.changes_layer) layer_z += 0.2;
        CHECK(way.z == Approx(layer_z));
        const bool hop = way.drawn > 0 && way.length() >= profile.gcode.z_hop_from;
        hops += hop;
        if (way.points.empty()) continue;
        CHECK(way.travel_z == Approx(hop ? layer_z + 0.6 : layer_z));
        // At a change of layers one lift does for both.
        CHECK(way.heights.size() == (hop ? 2 : way.changes_layer ? 1 : 0));
    }
    CHECK(hops > 4);
    // The last layer may be as high as the bed allows, and so does the nozzle then.
    profile.filament.bed_z = 1.1;
    for (const Way& way : read(print(job, profile)).ways) CHECK(way.travel_z <= 1.1);
    // Where nothing is drawn back, nothing rises.
    profile.filament.retraction = 0;
    for (const Way& way : read(print(job, profile)).ways) CHECK(way.heights.size() == way.changes_layer);
}

TEST_CASE("wiping draws back along the bead, and as much as without", "[gcode][travel]") {
    PrinterProfile profile = plain();
    const Job job = GENERATE(columns(), windowed());
    const Reading dry = read(print(job, profile));
    profile.gcode.wipe = GENERATE(0.5, 3.0, 40.0);
    profile.gcode.lines_per_second = GENERATE(0.0, 80.0);
    const std::string text = print(job, profile);
    const Reading reading = read(text);
    CHECK(reading.extruded == Approx(dry.extruded).epsilon(1e-5));
    CHECK(gcode_fact(text, "filament used [mm]") == Approx(reading.extruded).margin(0.006));
    CHECK(reading.all == Approx(reading.extruded - 0.8).margin(1e-6));
    int wipes = 0;
    for (std::size_t i = 0; i < reading.ways.size(); ++i) {
        const Way& way = reading.ways[i];
        if (way.drawn == 0) continue;
        REQUIRE(!way.wiped.empty());
        ++wipes;
        CHECK(way.drawn == Approx(0.8).margin(1e-9));
        CHECK(way.pushed == Approx(0.8).margin(1e-9));
        const std::vector<dvec2>& bead = reading.beads[i];
        dvec2 at = bead.back();
        double gone = 0;
        for (const dvec2 p : way.wiped) {
            gone += glm::distance(std::exchange(at, p), p);
            double least = infinity;
            for (std::size_t k = 1; k < bead.size(); ++k) {
                const dvec2 a = bead[k - 1], step = bead[k] - a;
                const double t = std::clamp(glm::dot(p - a, step) / glm::dot(step, step), 0.0, 1.0);
                least = std::min(least, glm::distance(p, a + step * t));
            }
            CHECK(least < 2 * profile.filament.tolerance);
        }
        CHECK(gone <= profile.gcode.wipe + 0.01);
        if (profile.gcode.wipe < 1) CHECK(gone == Approx(profile.gcode.wipe).margin(0.01));
    }
    CHECK(wipes >= 10);
}

TEST_CASE("moves without extrusion are continued byte for byte, and not with other settings",
          "[gcode][travel]") {
    const TemporaryFolder folder;
    PrinterProfile profile = plain();
    profile.gcode.wipe = 2;
    profile.gcode.z_hop = 0.4;
    profile.gcode.lines_per_second = 100;
    const Job job = columns();
    const int stop = GENERATE(0, 1, 4);
    run_layers(job, *make_gcode(profile, folder / "parts", false), {0, 5}, false, stop);
    const auto refused = [&](auto change) {
        PrinterProfile other = profile;
        change(other.gcode);
        CHECK_THROWS_WITH(make_gcode(other, folder / "parts", false)->open(job, {0, 5}, true),
                          Catch::Contains("other printer settings"));
    };
    refused([](GcodeProfile& g) { g.travel_inside = false; });
    refused([](GcodeProfile& g) { g.retract_from = 3; });
    refused([](GcodeProfile& g) { g.retract_inside_from = 3; });
    refused([](GcodeProfile& g) { g.wipe = 3; });
    refused([](GcodeProfile& g) { g.z_hop = 3; });
    refused([](GcodeProfile& g) { g.z_hop_from = 3; });
    run_layers(job, *make_gcode(profile, folder / "parts", false), {0, 5}, true);
    CHECK(read_text(folder / "parts") == print(job, profile));
}

TEST_CASE("lines a second hold over the seams of layers of few moves, too", "[gcode][travel][rate]") {
    // Few beads a layer, some of which begin where the last one ended.
    const Job job = make_job(
        {{-2, -2, 0}, {2, 2, 8}},
        [](double z) {
            const int layer = static_cast<int>(z / 0.2);
            std::vector<Figure> figures;
            if (layer % 7 != 3) figures.push_back(disc({0, 0}, 0.15 + 0.2 * (layer / 5 % 4)));
            if (layer % 11 == 5) figures.push_back(disc({1, 1}, 0.8));
            return figures;
        },
        0.2);
    PrinterProfile profile = plain();
    profile.gcode.lines_per_second = GENERATE(1.0, 20.0, 60.0);
    profile.gcode.planner_blocks = GENERATE(2, 5, 16);
    profile.filament.retraction = GENERATE(0.0, 0.8);
    profile.gcode.wipe = GENERATE(0.0, 1.0);
    profile.gcode.z_hop = GENERATE(0.0, 0.3);
    RateMeter meter(profile.gcode.planner_blocks);
    double speed = 1, z = 0;
    dvec2 at{0};
    for (const GcodeLine& line : gcode_lines(print(job, profile))) {
        if (line.command != "G0" && line.command != "G1") continue;
        if (line.has('F')) speed = line.words.at('F') / 60;
        double length = line.has('E') ? std::abs(line.words.at('E')) : 0;
        if (line.has('Z')) length = std::abs(std::exchange(z, line.words.at('Z')) - line.words.at('Z'));
        if (line.has('X')) {
            const dvec2 to{line.words.at('X'), line.words.at('Y')};
            length = glm::distance(std::exchange(at, to), to);
        }
        meter.add(length / speed);
    }
    CAPTURE(profile.gcode.planner_blocks, profile.filament.retraction, profile.gcode.wipe,
            profile.gcode.z_hop);
    CHECK(meter.worst() > 0);
    CHECK(meter.worst() <= profile.gcode.lines_per_second * 1.01);  // positions are rounded
}

}  // namespace gcode_travel_test
