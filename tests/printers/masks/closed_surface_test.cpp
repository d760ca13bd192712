// G-code of parts with sparse infill: closed on top and below, bridged where there is nothing under it.
#include <catch2/catch.hpp>
#include <map>
#include <sstream>

#include "printers/gcode/gcode.h"
#include "tests/printers/common/plane_solids.h"

namespace closed_surface_test {

using namespace lamella;
using namespace lamella::test;

namespace {

struct Line {
    dvec2 from;
    dvec2 to;
    double width;
    std::string role;
    double speed;  // mm/s
    double fan;    // as of M106
    double filament;
};

/// Extrusions of each layer, in part coordinates when the part is centred on the bed.
std::vector<std::vector<Line>> lines_of(const std::string& text, dvec2 center) {
    std::vector<std::vector<Line>> layers;
    std::istringstream in(text);
    std::string role;
    dvec2 at{0};
    double width = 0, speed = 0, fan = 0;
    for (std::string line; std::getline(in, line);) {
        if (line == ";LAYER_CHANGE") layers.emplace_back();
        if (line.starts_with(";TYPE:")) role = line.substr(6);
        if (line.starts_with(";WIDTH:")) width = std::stod(line.substr(7));
        if (line.starts_with("M106 S")) fan = std::stod(line.substr(6));
        if (line.starts_with("M107")) fan = 0;
        if (!line.starts_with("G0 ") && !line.starts_with("G1 ")) continue;
        std::map<char, double> words;
        std::istringstream stream(line.substr(3));
        for (std::string word; stream >> word;) words[word[0]] = std::stod(word.substr(1));
        if (words.contains('F')) speed = words['F'] / 60;
        if (!words.contains('X')) continue;
        const dvec2 to(words['X'] - 110 + center.x, words['Y'] - 110 + center.y);
        if (words.contains('E') && words['E'] > 0 && !layers.empty() && role != "Custom")
            layers.back().push_back({at, to, width, role, speed, fan, words['E']});
        at = to;
    }
    return layers;
}

double distance(dvec2 p, const Line& line) {
    const dvec2 way = line.to - line.from;
    const double square = glm::dot(way, way);
    const double t = square > 0 ? std::clamp(glm::dot(p - line.from, way) / square, 0.0, 1.0) : 0;
    return glm::distance(p, line.from + way * t);
}

bool covered(dvec2 p, const std::vector<Line>& lines) {
    return std::ranges::any_of(lines,
                               [&](const Line& line) { return distance(p, line) <= line.width / 2 + 0.02; });
}

std::vector<std::vector<Line>> print(const Job& job, const PrinterProfile& profile) {
    const TemporaryFolder folder;
    run_layers(job, *make_gcode(profile, folder / "out.gcode", false), {0, job.layers.count()});
    const dvec3 center = job.bounds.center();
    return lines_of(read_text(folder / "out.gcode"), {center.x, center.y});
}

/// Half a ball upside down on a stem would need supports; this is a dome, open nowhere.
double dome_radius(double z) { return z < 12 ? std::sqrt(144 - z * z) : 0; }

Job dome() {
    return make_job(
        {{-12, -12, 0}, {12, 12, 12}},
        [](double z) {
            return std::vector<Figure>{disc({0, 0}, dome_radius(z))};
        },
        0.4);
}

/// A box with a chamber of 16 x 8 mm from z = 2 to z = 4, under a lid of 2 mm.
Job chamber() {
    return make_job(
        {{-15, -10, 0}, {15, 10, 6}},
        [](double) {
            return std::vector<Figure>{rectangle({-15, -10}, {15, 10})};
        },
        0.2,
        [](double z) {
            return z > 2 && z < 4 ? std::vector<Figure>{rectangle({-8, -4}, {8, 4})} : std::vector<Figure>();
        });
}

}  // namespace

TEST_CASE("what is open above within a few layers is closed, and the core is sparse", "[skins]") {
    PrinterProfile profile;
    profile.filament.infill_density = 0.15;
    profile.toolpath.top_layers = GENERATE(1, 3);
    profile.toolpath.infill = GENERATE(InfillPattern::lines, InfillPattern::concentric);
    const int top = profile.toolpath.top_layers;
    const Job job = dome();
    const auto layers = print(job, profile);
    REQUIRE(layers.size() == 30);
    int open = 0, gaps = 0, core = 0, filled = 0;
    for (int i = 0; i < 30; ++i) {
        const double radius = dome_radius(job.plane(i)), above = dome_radius(job.plane(i + top));
        for (double y = -12; y < 12; y += 0.3) {
            for (double x = -12; x < 12; x += 0.3) {
                const double r = glm::length(dvec2(x, y));
                const auto& lines = layers[static_cast<std::size_t>(i)];
                if (r < radius - 0.25 && (r > above + 0.05 || i < 3)) {
                    ++open;
                    gaps += covered({x, y}, lines) ? 0 : 1;
                } else if (i >= 3 && r < above - 4) {
                    ++core;
                    filled += covered({x, y}, lines) ? 1 : 0;
                }
            }
        }
    }
    CAPTURE(open, gaps, core, filled);
    CHECK(open > 5000);
    CHECK(gaps < 0.01 * open);
    CHECK(core > 5000);
    CHECK(filled < 0.35 * core);
}

TEST_CASE("without solid layers sparse infill goes up to the surface", "[skins]") {
    PrinterProfile profile;
    profile.filament.infill_density = 0.15;
    profile.toolpath.top_layers = profile.toolpath.bottom_layers = 0;
    for (const auto& layer : print(dome(), profile)) {
        for (const Line& line : layer) CHECK(line.role != "Solid infill");
    }
}

TEST_CASE("a lid bridges its chamber the short way, with its own flow, speed and fan", "[skins]") {
    PrinterProfile profile;
    profile.filament.infill_density = GENERATE(0.15, 1.0);
    profile.gcode.bridge_speed = 17;
    profile.gcode.bridge_flow = 1.2;
    profile.gcode.fan = 0.5;
    profile.gcode.bridge_fan = 1;
    const Job job = chamber();
    const auto layers = print(job, profile);
    const std::size_t lid = 20;  // the first layer above z = 4
    double plastic = 0, length = 0;
    for (std::size_t i = 0; i < layers.size(); ++i) {
        for (const Line& line : layers[i]) {
            const bool bridge = line.role == "Bridge infill";
            CHECK((bridge ? i == lid : true));
            if (i == 0) continue;
            CHECK((line.speed == Approx(17)) == bridge);
            CHECK(line.fan == Approx(bridge ? 255 : 127).margin(1));
            if (!bridge) continue;
            const dvec2 way = line.to - line.from;
            CHECK(std::abs(way.x) < 1e-3);
            CHECK(std::min(line.from.y, line.to.y) < -4);  // it rests on both banks
            CHECK(std::max(line.from.y, line.to.y) > 4);
            plastic += line.filament;
            length += std::abs(way.y);
        }
    }
    CHECK(length > 8 * 16 / 0.45);
    // What the bridge and its anchors take, 1.2 times.
    const double volume = plastic * pi / 4 * 1.75 * 1.75, pitch = 0.45 - 0.2 * (1 - pi / 4);
    CHECK(volume / (length * pitch * 0.2) == Approx(1.2).epsilon(0.1));
}

TEST_CASE("walls that stand out over the void are overhangs", "[skins]") {
    // A mushroom: the cap's first layer stands out by 4 mm all round.
    const Job job = make_job(
        {{-10, -10, 0}, {10, 10, 2}},
        [](double z) {
            return std::vector<Figure>{disc({0, 0}, z < 1 ? 6 : 10)};
        },
        0.2);
    const auto layers = print(job, PrinterProfile());
    for (std::size_t i = 0; i < layers.size(); ++i) {
        for (const Line& line : layers[i]) {
            const double r = glm::length((line.from + line.to) * 0.5);
            if (line.role == "Overhang perimeter") {
                CHECK(i == 5);
                CHECK(r > 6);
            } else if (line.role.ends_with("erimeter")) {
                CHECK(i != 5);
            }
        }
    }
    CHECK(std::ranges::any_of(layers[5], [](const Line& line) { return line.role == "Overhang perimeter"; }));
}

}  // namespace closed_surface_test
