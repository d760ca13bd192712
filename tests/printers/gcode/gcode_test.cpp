// G-code read back: the right volume in the right place, and nothing that a printer would choke on.
#include "printers/gcode/gcode.h"

#include <catch2/catch.hpp>
#include <map>
#include <sstream>

#include "engine/base/error.h"
#include "tests/printers/common/plane_solids.h"
#include "tests/printers/toolpath/supported_table.h"

namespace gcode_test {

using namespace lamella;
using namespace lamella::test;
namespace fs = std::filesystem;

namespace {

/// An extruding move over the part.
struct Extrusion {
    dvec2 from;
    dvec2 to;
    double z;
    double filament;
    std::string role;
    double speed;  ///< mm/s
};

/// What an interpreter of the file sees.
struct Print {
    std::vector<Extrusion> extrusions;
    std::vector<double> heights;  ///< of ;LAYER_CHANGE
    std::map<std::string, int> roles;
    double prime = 0;
    double unretracted = 0;  ///< net of all retractions
    double longest_dry_travel = 0;
};

/// A strict interpreter of the few commands that may occur.
Print interpret(const std::string& text) {
    Print print;
    std::istringstream in(text);
    std::string line;
    std::string role;
    dvec2 position{0};
    double z = 0;
    bool layers = false;
    double speed = 0;
    while (std::getline(in, line)) {
        INFO(line);
        REQUIRE(line.size() <= 95);
        REQUIRE(std::all_of(line.begin(), line.end(), [](char c) { return ' ' <= c && c <= '~'; }));
        if (line.starts_with(";TYPE:")) ++print.roles[role = line.substr(6)];
        if (line == ";LAYER_CHANGE" && !std::exchange(layers, true))
            z = 0;  // the priming line may lie higher
        if (line.starts_with(";Z:")) print.heights.push_back(std::stod(line.substr(3)));
        if (line.starts_with(";") || !(line.starts_with("G0 ") || line.starts_with("G1 "))) continue;
        REQUIRE(line.find("-0 ") == std::string::npos);
        REQUIRE(line.find('e') == std::string::npos);
        const bool extruding = line[1] == '1';
        std::map<char, double> words;
        std::istringstream stream(line.substr(3));
        for (std::string word; stream >> word;) {
            std::size_t used = 0;
            words[word[0]] = std::stod(word.substr(1), &used);
            REQUIRE(used + 1 == word.size());
            const std::size_t point = word.find('.');
            if (point != std::string::npos) REQUIRE(word.size() - point - 1 <= (word[0] == 'E' ? 5U : 3U));
        }
        if (words.contains('F')) {
            REQUIRE(words['F'] > 0);
            speed = words['F'] / 60;
        }
        if (words.contains('Z')) {
            REQUIRE(words.size() <= 2);
            if (layers) REQUIRE(words['Z'] >= z);
            z = words['Z'];
            continue;
        }
        if (!words.contains('X')) {  // retraction or its end
            REQUIRE(extruding);
            print.unretracted += words['E'];
            REQUIRE(std::abs(words['E']) == Approx(0.8));
            continue;
        }
        const dvec2 to{words['X'], words['Y']};
        REQUIRE(extruding == words.contains('E'));
        if (extruding) {
            REQUIRE(words['E'] >= 0);
            REQUIRE(print.unretracted == Approx(0).margin(1e-9));
            if (layers) {
                print.extrusions.push_back({position, to, z, words['E'], role, speed});
            } else {
                print.prime += words['E'];
            }
        } else if (layers && print.unretracted > -0.1) {
            print.longest_dry_travel = std::max(print.longest_dry_travel, glm::distance(position, to));
        }
        position = to;
    }
    return print;
}

double volume_of(const Print& print, double filament) {
    double sum = 0;
    for (const Extrusion& e : print.extrusions) sum += e.filament * pi / 4 * filament * filament;
    return sum;
}

PrinterProfile filament_printer() {
    PrinterProfile profile;
    profile.name = "marlin";
    return profile;
}

Job puck() {
    return make_job(
        {{-8, -8, 1}, {8, 8, 3}},
        [](double) {
            return std::vector<Figure>{disc({0, 0}, 8)};
        },
        0.2);
}

Job brick() {
    return make_job(
        {{100, 100, 0}, {120, 110, 2}},
        [](double) {
            return std::vector<Figure>{rectangle({100, 100}, {120, 110})};
        },
        0.25,
        [](double) {
            return std::vector<Figure>{disc({106, 105}, 3)};
        });
}

/// Struts of many sizes, with a layer that is empty.
Job forest() {
    return make_job(
        {{0, 0, 0}, {18, 18, 3}},
        [](double z) {
            std::vector<Figure> figures;
            if (z > 1.2 && z < 1.4) return figures;
            for (int i = 0; i < 36; ++i) {
                const dvec2 center(1.5 + i % 6 * 3.0, 1.5 + (i - i % 6) / 6.0 * 3.0);
                figures.push_back(disc(center, 0.05 + 0.036 * i * (1 - z / 10)));
            }
            return figures;
        },
        0.2);
}

std::string print_whole(const Job& job, const PrinterProfile& profile, LayerRange range) {
    const TemporaryFolder folder;
    run_layers(job, *make_gcode(profile, folder / "out.gcode", false), range);
    return read_text(folder / "out.gcode");
}

/// The lines between one layer change and the next, without those before the first bead.
std::vector<std::string> layer_bodies(const std::string& text) {
    std::vector<std::string> bodies;
    std::size_t at = text.find(";LAYER_CHANGE");
    while (at != std::string::npos) {
        const std::size_t next = text.find(";LAYER_CHANGE", at + 1);
        const std::string layer = text.substr(at, next == std::string::npos ? next : next - at);
        const std::size_t bead = layer.find(";TYPE:");
        const std::size_t end = layer.find(";TYPE:Custom");
        bodies.push_back(
            bead == std::string::npos ? "" : layer.substr(bead, end == std::string::npos ? end : end - bead));
        at = next;
    }
    return bodies;
}

}  // namespace

TEST_CASE("a solid part gets its volume of plastic", "[gcode]") {
    const PrinterProfile profile = filament_printer();
    const Print round = interpret(print_whole(puck(), profile, {0, 10}));
    CHECK(volume_of(round, 1.75) == Approx(pi * 64 * 2).epsilon(0.03));
    CHECK(round.heights.size() == 10);
    CHECK(round.heights.front() == Approx(0.2));
    CHECK(round.heights.back() == Approx(2));
    CHECK(round.roles.at("External perimeter") == 10);
    CHECK(round.roles.at("Solid infill") == 10);
    CHECK(round.prime > 1);
    const Print square = interpret(print_whole(brick(), profile, {0, 8}));
    CHECK(volume_of(square, 1.75) == Approx((200 - pi * 9) * 2).epsilon(0.03));
}

TEST_CASE("plastic lies inside the part, centred on the bed", "[gcode]") {
    PrinterProfile profile = filament_printer();
    profile.filament.infill_density = GENERATE(1.0, 0.25, 0.0);
    const Print print = interpret(print_whole(brick(), profile, {0, 8}));
    Rect reached;
    for (const Extrusion& e : print.extrusions) {
        for (const dvec2 p : {e.from, e.to, (e.from + e.to) * 0.5}) {
            reached = unite(reached, Rect{p, p});
            REQUIRE(std::abs(p.x - 110) < 10 - 0.2);
            REQUIRE(std::abs(p.y - 110) < 5 - 0.2);
            REQUIRE(glm::distance(p, dvec2(106, 110)) > 3 + 0.2 - 0.03);
        }
    }
    CHECK(reached.lo.x == Approx(100 + 0.225).margin(0.03));
    CHECK(reached.hi.y == Approx(115 - 0.225).margin(0.03));
    // Three solid layers below and four above leave one of the eight.
    CHECK(print.roles.contains("Internal infill") == (profile.filament.infill_density == 0.25));
    CHECK(print.roles.at("Solid infill") == (profile.filament.infill_density == 1.0 ? 8 : 7));
}

TEST_CASE("long ways between islands are made with the filament drawn back", "[gcode]") {
    const Print print = interpret(print_whole(forest(), filament_printer(), {0, 15}));
    CHECK(print.heights.size() == 15);
    CHECK(print.unretracted == Approx(-0.8));  // at the end it is drawn back for good
    CHECK(print.longest_dry_travel < 10);
    PrinterProfile never = filament_printer();
    never.filament.retraction = 0;
    CHECK(interpret(print_whole(forest(), never, {0, 15})).unretracted == 0);
}

TEST_CASE("struts too thin for any bead are counted in the file", "[gcode]") {
    const std::string text = print_whole(forest(), filament_printer(), {0, 1});
    // Radii 0.05 + 0.03564 i; a quarter of the line width squared is the area of a disc of radius 0.127.
    CHECK(text.find("; islands too small for a bead = 3\n") != std::string::npos);
    CHECK(text.find("; filament used [mm] = ") != std::string::npos);
    CHECK(text.find("; estimated printing time (normal mode) = ") != std::string::npos);
    CHECK(text.starts_with("; generated by Lamella "));
}

TEST_CASE("a layer's beads are the same in a shard", "[gcode]") {
    const Job job = forest();
    const auto whole = layer_bodies(print_whole(job, filament_printer(), {0, 15}));
    const auto shard = layer_bodies(print_whole(job, filament_printer(), {5, 9}));
    REQUIRE(whole.size() == 15);
    REQUIRE(shard.size() == 4);
    for (std::size_t i = 0; i < 4; ++i) CHECK(shard[i] == whole[i + 5]);
    CHECK(whole[6].empty());
    CHECK(whole[7].size() > 1000);
}

TEST_CASE("paths are not planned to their end for a layer that is not wanted any more", "[gcode]") {
    const TemporaryFolder folder;
    const Job job = forest();
    const auto backend = make_gcode(filament_printer(), folder / "out.gcode", false);
    backend->open(job, {0, job.layers.count()}, false);
    CancelToken token;
    CHECK_NOTHROW(backend->render(Layer(job, 3, &token)));
    token.cancel();
    CHECK_THROWS_AS(backend->render(Layer(job, 3, &token)), Interrupted);
}

TEST_CASE("G-code that was stopped is continued byte for byte", "[gcode]") {
    const TemporaryFolder folder;
    const Job job = forest();
    const int stop = GENERATE(0, 1, 7, 14);
    CAPTURE(stop);
    run_layers(job, *make_gcode(filament_printer(), folder / "parts", false), {0, 15}, false, stop);
    std::ofstream(folder / "parts.partial", std::ios::app) << "G1 X1";
    run_layers(job, *make_gcode(filament_printer(), folder / "parts", false), {0, 15}, true);
    CHECK(read_text(folder / "parts") == print_whole(job, filament_printer(), {0, 15}));
}

TEST_CASE("parts that do not fit and senseless printers are refused", "[gcode]") {
    const TemporaryFolder folder;
    const auto begin = [&](auto change, const Job& job = puck()) {
        PrinterProfile profile = filament_printer();
        change(profile.filament);
        make_gcode(profile, folder / "out", false)->open(job, {0, 1}, false);
    };
    CHECK_THROWS_WITH(begin([](FilamentProfile& f) { f.bed_x = 27.9 + 2.1; },
                            make_job(
                                {{0, 0, 0}, {18.1, 5, 2}},
                                [](double) {
                                    return std::vector<Figure>{rectangle({0, 0}, {18.1, 5})};
                                },
                                0.2)),
                      Catch::Contains("18.100 x 5.000 x 2.000") && Catch::Contains("18.000"));
    CHECK_THROWS_WITH(begin([](FilamentProfile& f) { f.bed_z = 1.9; }), Catch::Contains("1.900"));
    CHECK_THROWS_WITH(begin([](FilamentProfile& f) { f.line_width = 0.1; }), Catch::Contains("line_width"));
    CHECK_THROWS_WITH(begin([](FilamentProfile& f) { f.infill_density = 1.5; }),
                      Catch::Contains("infill_density"));
    CHECK_THROWS_WITH(begin([](FilamentProfile& f) { f.infill_density = 1e-9; }),
                      Catch::Contains("infill_density"));
    CHECK_THROWS_AS(begin([](FilamentProfile& f) { f.travel_speed = 0; }), InputError);
    CHECK_THROWS_AS(begin([](FilamentProfile& f) { f.filament = std::nan(""); }), InputError);
    CHECK(!fs::exists(folder / "out.partial"));
}

TEST_CASE("hostile job names do not become commands", "[gcode]") {
    Job job = puck();
    job.name = std::string("x\nM112\n") + std::string(500, 'y');
    const std::string text = print_whole(job, filament_printer(), {0, 1});
    CHECK(text.find("\nM112") == std::string::npos);
    interpret(text);
}

TEST_CASE("supports are printed in their own role, at their own speed, with their volume", "[gcode]") {
    PrinterProfile profile = filament_printer();
    profile.support.speed = 33;
    const Job job = supported_table();
    const std::string text = print_whole(job, profile, {0, 20});
    const Print print = interpret(text);
    std::map<int, double> volumes;  // of supports, by layer
    double part = 0;
    double filament = 0;
    for (const Extrusion& e : print.extrusions) {
        const double volume = e.filament * pi / 4 * 1.75 * 1.75;
        const bool support = e.role == "Support material";
        REQUIRE(support == (e.z < 3.1));
        (support ? volumes[static_cast<int>(std::lround(e.z / 0.2)) - 1] : part) += volume;
        if (support) filament += e.filament;
        CHECK(e.speed == Approx(e.z < 0.3 ? 20 : support ? 33 : 40));
    }
    CHECK(part == Approx(table_area * 1).epsilon(0.03));
    REQUIRE(volumes.size() == 15);
    for (const auto& [layer, volume] : volumes) {
        CAPTURE(layer);
        CHECK(volume == Approx(scaffold_area(job.plane(layer)) * 0.2).epsilon(layer < 2 ? 0.05 : 0.02));
    }
    const std::string footer = "; support material used [mm] = ";
    const std::size_t at = text.find(footer);
    REQUIRE(at != std::string::npos);
    CHECK(std::stod(text.substr(at + footer.size())) == Approx(filament).margin(0.02));
    const std::string used = "; filament used [mm] = ";
    CHECK(std::stod(text.substr(text.find(used) + used.size())) ==
          Approx(volume_of(print, 1.75) / (pi / 4 * 1.75 * 1.75) + print.prime).margin(0.05));
}

TEST_CASE("bars are printed lengthwise, pillars in single lines, hollow parts on full supports", "[gcode]") {
    PrinterProfile profile = filament_printer();
    profile.filament.infill_density = 0;
    profile.toolpath.top_layers = profile.toolpath.bottom_layers = 0;
    const Print print = interpret(print_whole(supported_table(), profile, {0, 20}));
    double along = 0;
    double across = 0;
    double pillars = 0;
    for (const Extrusion& e : print.extrusions) {
        const dvec2 way = e.to - e.from;
        if (2.1 < e.z && e.z < 2.3) (std::abs(way.x) > std::abs(way.y) ? along : across) += glm::length(way);
        if (0.9 < e.z && e.z < 1.1) pillars += glm::length(way);
    }
    CHECK(along == Approx(2 * (12 - 0.45)).epsilon(0.01));
    CHECK(across == Approx(2 * 0.45).epsilon(0.05));
    CHECK(pillars == Approx(2 * 2 * 2.25).epsilon(0.03));
    CHECK(print.roles.at("Support material") == 15);
    CHECK(!print.roles.contains("Solid infill"));
}

TEST_CASE("supports come before the part of their layer", "[gcode]") {
    const Print print = interpret(print_whole(block_beside_support(), filament_printer(), {0, 4}));
    std::map<double, std::vector<bool>> order;
    for (const Extrusion& e : print.extrusions) order[e.z].push_back(e.role == "Support material");
    REQUIRE(order.size() == 4);
    for (const auto& [z, supports] : order) {
        CAPTURE(z);
        CHECK(supports.front());
        CHECK(!supports.back());
        CHECK(std::is_sorted(supports.rbegin(), supports.rend()));
    }
}

TEST_CASE("supports add up when a print is stopped and continued", "[gcode]") {
    const TemporaryFolder folder;
    const Job job = supported_table();
    const int stop = GENERATE(1, 7, 14, 17);
    run_layers(job, *make_gcode(filament_printer(), folder / "parts", false), {0, 20}, false, stop);
    run_layers(job, *make_gcode(filament_printer(), folder / "parts", false), {0, 20}, true);
    CHECK(read_text(folder / "parts") == print_whole(job, filament_printer(), {0, 20}));
    PrinterProfile other = filament_printer();
    other.support.speed = 10;
    run_layers(job, *make_gcode(filament_printer(), folder / "other", false), {0, 20}, false, stop);
    CHECK_THROWS_WITH(make_gcode(other, folder / "other", false)->open(job, {0, 20}, true),
                      Catch::Contains("other printer settings"));
}

TEST_CASE("supports must fit the bed, and their speed the printer", "[gcode]") {
    const TemporaryFolder folder;
    PrinterProfile profile = filament_printer();
    Job wide = supported_table();
    wide.bounds.hi.x = 300;
    CHECK_THROWS_WITH(make_gcode(profile, folder / "a", false)->open(wide, {0, 1}, false),
                      Catch::Contains("with its supports"));
    profile.support.speed = 0;
    CHECK_THROWS_WITH(make_gcode(profile, folder / "a", false)->open(supported_table(), {0, 1}, false),
                      Catch::Contains("speed of supports"));
    CHECK_NOTHROW(make_gcode(profile, folder / "a", false)->open(puck(), {0, 1}, false));
    CHECK(print_whole(puck(), filament_printer(), {0, 2}).find("upport") == std::string::npos);
}

}  // namespace gcode_test
