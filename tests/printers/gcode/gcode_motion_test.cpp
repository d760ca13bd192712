// What profiles do to G-code: dialects, scripts, heat, fan, speeds, rates of lines, arcs, pictures.
#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "engine/base/number_format.h"
#include "printers/gcode/gcode.h"
#include "printers/gcode/gcode_script.h"
#include "printers/gcode/gcode_thumbnail.h"
#include "tests/printers/common/plane_solids.h"
#include "tests/printers/gcode/gcode_lines.h"
#include "tests/printers/toolpath/supported_table.h"

namespace gcode_motion_test {

using namespace lamella;
using namespace lamella::test;

namespace {

PrinterProfile plain() {
    PrinterProfile profile;
    profile.name = "marlin";
    return profile;
}

/// A round column that tapers to 1.5 mm, and a thin one beside it.
Job cones() {
    return make_job(
        {{-8, -8, 0}, {8, 8, 4}},
        [](double z) {
            return std::vector<Figure>{disc({-1, 0}, 7 - 1.4 * z), disc({7.4, 0}, 0.4)};
        },
        0.2);
}

std::string print(const Job& job, const PrinterProfile& profile, LayerRange range) {
    const TemporaryFolder folder;
    run_layers(job, *make_gcode(profile, folder / "out.gcode", false), range);
    return read_text(folder / "out.gcode");
}
std::string print(const PrinterProfile& profile) { return print(cones(), profile, {0, 20}); }

/// The lines of each layer, from its change to the next.
std::vector<std::vector<GcodeLine>> by_layer(const std::string& text) {
    std::vector<std::vector<GcodeLine>> layers;
    for (const GcodeLine& line : gcode_lines(text)) {
        if (line.text == ";LAYER_CHANGE") layers.emplace_back();
        if (!layers.empty()) layers.back().push_back(line);
    }
    return layers;
}

int count(const std::vector<GcodeLine>& lines, const std::string& text) {
    return static_cast<int>(std::ranges::count(lines, text, &GcodeLine::text));
}

double filament_of(const std::vector<PlaneMove>& moves) {
    double sum = 0;
    for (const PlaneMove& move : moves) sum += move.filament;
    return sum;
}

/// The most moves a second in any window of 16, at the speeds that are written. Lifts and retractions count.
double worst_window(const std::string& text) {
    std::vector<double> seconds;
    double speed = 1, z = 0;
    dvec2 at{0};
    for (const GcodeLine& line : gcode_lines(text)) {
        if (line.command.size() != 2 || line.command[0] != 'G') continue;
        if (line.has('F')) speed = line.words.at('F') / 60;
        double length = line.has('E') ? std::abs(line.words.at('E')) : 0;
        if (line.has('X')) {
            const dvec2 to{line.words.at('X'), line.words.at('Y')};
            length = line.has('I') ? arc_length(at, to, at + dvec2(line.words.at('I'), line.words.at('J')),
                                                line.command == "G3")
                                   : glm::distance(at, to);
            at = to;
        }
        if (line.has('Z')) length = std::abs(std::exchange(z, line.words.at('Z')) - line.words.at('Z'));
        seconds.push_back(length / speed);
    }
    double worst = 0;
    for (std::size_t i = 0; i + 16 <= seconds.size(); ++i) {
        double sum = 0;
        for (std::size_t k = i; k < i + 16; ++k) sum += seconds[k];
        worst = std::max(worst, 16 / sum);
    }
    return worst;
}

}  // namespace

TEST_CASE("each firmware is told in its own words", "[gcode][flavour]") {
    PrinterProfile profile = plain();
    profile.gcode.fan = 0.4;
    profile.gcode.wall_acceleration = 700;
    profile.gcode.travel_acceleration = 2000;
    const auto lines = [&](Flavour flavour) {
        profile.gcode.flavour = flavour;
        return gcode_lines(print(profile));
    };
    const auto marlin = lines(Flavour::marlin);
    CHECK(count(marlin, "M106 S102") == 19);
    CHECK(count(marlin, "M73 P0") == 2);
    CHECK(count(marlin, "M73 P100 R0") == 1);
    CHECK(count(marlin, "M204 T2000") == 1);
    double acceleration = 0;
    std::string role;
    for (const GcodeLine& line : marlin) {
        if (line.text.starts_with(";TYPE:")) role = line.text.substr(6);
        if (line.command == "M204" && line.has('P')) acceleration = line.words.at('P');
        if (role == "Custom" || !line.has('X') || !line.has('E')) continue;
        CHECK(acceleration == (role == "External perimeter" ? 700 : 1000));
    }
    const auto klipper = lines(Flavour::klipper);
    CHECK(count(klipper, "M106 S102") == 19);
    CHECK(count(klipper, "SET_PRINT_STATS_INFO TOTAL_LAYER=20") == 1);
    CHECK(count(klipper, "SET_PRINT_STATS_INFO CURRENT_LAYER=7") == 1);
    CHECK(count(klipper, "M204 S2000") > 20);
    const auto reprap = lines(Flavour::reprapfirmware);
    CHECK(count(reprap, "M106 P0 S0.4") == 19);
    CHECK(count(reprap, "M204 P700") == count(marlin, "M204 P700"));
    for (const GcodeLine& line : klipper) {
        CHECK(line.command != "M73");
        CHECK_FALSE((line.command == "M204" && line.text.find('S') == std::string::npos));
    }
    // The way is the same for all.
    const auto moves = [&](Flavour flavour) {
        profile.gcode.flavour = flavour;
        std::string text;
        for (const GcodeLine& line : gcode_lines(print(profile)))
            if (line.command.starts_with("G")) text += line.text + "\n";
        return text;
    };
    CHECK(moves(Flavour::marlin) == moves(Flavour::klipper));
    CHECK(moves(Flavour::marlin) == moves(Flavour::reprapfirmware));
}

TEST_CASE("scripts stand where they belong, with values for variables", "[gcode][script]") {
    PrinterProfile profile = plain();
    profile.filament.nozzle_temperature = 215;
    profile.gcode.first_layer_nozzle_temperature = 225;
    profile.gcode.start_script = "START T={nozzle_temperature} B={bed_temperature} OF={layers}\nG28";
    profile.gcode.layer_script = "M117 {layer}/{layers} at {z} by {height}, {{now}}";
    profile.gcode.end_script = "M104 S0\nM117 {filament_used} mm on {bed_x}";
    const std::string text = print(profile);
    const auto lines = gcode_lines(text);
    CHECK(count(lines, "START T=225 B=60 OF=20") == 1);
    CHECK(count(lines, "M109 S210") == 0);
    CHECK(text.find("START") < text.find("\nG28\n"));
    CHECK(text.find("\nG28\n") < text.find("\nM83\n"));
    const auto layers = by_layer(text);
    REQUIRE(layers.size() == 20);
    CHECK(count(layers[0], "M117 1/20 at 0.2 by 0.2, {now}") == 1);
    CHECK(count(layers[6], "M117 7/20 at 1.4 by 0.2, {now}") == 1);
    CHECK(count(lines, "M117 " + format_number(gcode_fact(text, "filament used [mm]"), 2) + " mm on 220") ==
          1);
    CHECK(count(lines, "M84") == 0);
    profile.gcode.prime_line = false;
    const std::string bare = print(profile);
    CHECK(bare.find("\nG1") > bare.find(";LAYER_CHANGE"));
    CHECK(gcode_fact(bare, "filament used [mm]") < gcode_fact(text, "filament used [mm]") - 1);
}

TEST_CASE("scripts that no machine would read are refused with their line", "[gcode][script]") {
    const auto mistake = [](const std::string& script, Flavour flavour = Flavour::marlin) {
        return script_mistake(script, flavour).value_or("");
    };
    CHECK(mistake("") == "");
    CHECK(mistake("G28\n\nM117 {layer} {{}}") == "");
    CHECK_THAT(mistake("G28\nM117 {laier}"),
               Catch::StartsWith("line 2: there is no variable {laier}") && Catch::Contains("{layer}"));
    CHECK_THAT(mistake("M117 {layer"), Catch::Contains("line 1"));
    CHECK_THAT(mistake("M117 }"), Catch::Contains("line 1: a brace"));
    CHECK_THAT(mistake("G28\nM117 \xc3\xa9"), Catch::StartsWith("line 2: a character is not"));
    CHECK(mistake(std::string(95, 'x')) == "");
    CHECK_THAT(mistake("a\nb\n" + std::string(96, 'x')), Catch::StartsWith("line 3: it has up to 96 bytes"));
    CHECK(mistake(std::string(79, 'x'), Flavour::grbl) == "");
    CHECK_THAT(mistake(std::string(80, 'x'), Flavour::grbl), Catch::Contains("at most 79"));
    // What a variable may become counts, not its name.
    CHECK(mistake(std::string(88, 'x') + "{layer}") == "");
    CHECK_THAT(mistake(std::string(89, 'x') + "{layer}"), Catch::Contains("96 bytes"));
    PrinterProfile profile = plain();
    profile.gcode.layer_script = "M117 {no}";
    const TemporaryFolder folder;
    CHECK_THROWS_WITH(make_gcode(profile, folder / "out", false)->open(cones(), {0, 1}, false),
                      Catch::StartsWith("layer_script, line 1"));
}

TEST_CASE("the first layer has its own heat, and the fan comes on by and by", "[gcode]") {
    PrinterProfile profile = plain();
    profile.gcode.first_layer_nozzle_temperature = 225;
    profile.gcode.first_layer_bed_temperature = 70;
    profile.gcode.fan_off_layers = 2;
    profile.gcode.fan_ramp_layers = 3;
    profile.gcode.fan = 0.8;
    const std::string text = print(profile);
    CHECK(text.find("\nM190 S70\n") < text.find(";LAYER_CHANGE"));
    CHECK(text.find("\nM109 S225\n") < text.find(";LAYER_CHANGE"));
    const auto layers = by_layer(text);
    for (std::size_t i = 0; i < layers.size(); ++i) {
        CAPTURE(i);
        CHECK(count(layers[i], "M104 S210") == (i == 1 ? 1 : 0));
        CHECK(count(layers[i], "M140 S60") == (i == 1 ? 1 : 0));
        const int shares[] = {0, 0, 51, 102, 153, 204};  // quarters of 0.8 of 255
        const int share = shares[std::min<std::size_t>(i, 5)];
        CHECK(count(layers[i], share == 0 ? "M107" : "M106 S" + std::to_string(share)) >= 1);
    }
    // A shard that begins above the first layer never knew its heat.
    const std::string shard = print(cones(), profile, {3, 6});
    CHECK(shard.find("M109 S210\n") != std::string::npos);
    CHECK(shard.find("S225") == std::string::npos);
}

TEST_CASE("beads are as fast as their role says", "[gcode]") {
    PrinterProfile profile = plain();
    profile.gcode.wall_speed = 25;
    profile.gcode.inner_wall_speed = 45;
    profile.gcode.solid_speed = 70;
    profile.gcode.thin_speed = 33;
    int walls = 0, solid = 0;
    for (const PlaneMove& move : plane_moves(print(profile))) {
        if (move.filament <= 0 || move.role == "Custom") continue;
        const double wanted = move.layer == 0                     ? 20
                              : move.role == "External perimeter" ? 25
                              : move.role == "Perimeter"          ? 45
                              : move.role == "Solid infill"       ? 70
                                                                  : 33;
        CHECK(move.speed == Approx(wanted));
        walls += move.role == "External perimeter";
        solid += move.role == "Solid infill";
    }
    CHECK(walls > 100);
    CHECK(solid > 100);
}

TEST_CASE("small layers are slowed down, but not below the least speed", "[gcode]") {
    PrinterProfile profile = plain();
    const std::string fast = print(profile);
    profile.gcode.min_layer_time = 6;
    profile.gcode.min_speed = 12;
    const std::string text = print(profile);
    CHECK(filament_of(plane_moves(text)) == Approx(filament_of(plane_moves(fast))));
    std::vector<double> slowest(20, 1e9), seconds(20, 0), was(20, 0);
    for (const PlaneMove& move : plane_moves(text)) {
        if (move.layer < 0 || move.filament <= 0) continue;
        const auto i = static_cast<std::size_t>(move.layer);
        slowest[i] = std::min(slowest[i], move.speed);
        seconds[i] += move.length / move.speed;
    }
    for (const PlaneMove& move : plane_moves(fast)) {
        if (move.layer >= 0 && move.filament > 0)
            was[static_cast<std::size_t>(move.layer)] += move.length / move.speed;
    }
    CHECK(slowest[2] == 40);  // large enough
    CHECK(slowest[19] == Approx(12).margin(0.02));
    int between = 0;
    for (std::size_t i = 0; i < 20; ++i) {
        CAPTURE(i);
        CHECK(slowest[i] >= 12 - 0.02);
        CHECK(seconds[i] >= was[i] - 1e-9);
        if (slowest[i] < 39 && slowest[i] > 12.1 && i > 0) {
            ++between;  // its time is what was asked for, less what acceleration and ways between beads take
            CHECK(seconds[i] < 6);
            CHECK(seconds[i] > 6 * 0.6);
        }
    }
    CHECK(between >= 2);
    CHECK(gcode_fact(text, "filament used [mm]") == gcode_fact(fast, "filament used [mm]"));
}

TEST_CASE("a machine is never given more lines than it can take", "[gcode][rate]") {
    PrinterProfile profile = plain();
    profile.filament.tolerance = 0.002;
    profile.filament.print_speed = 100;
    const std::string free = print(profile);
    CHECK(worst_window(free) > 150);
    CHECK(std::isnan(gcode_fact(free, "slowed for the segment rate [mm]")));
    profile.gcode.lines_per_second = 40;
    profile.gcode.arcs = GENERATE(false, true);
    const std::string text = print(profile);
    CHECK(worst_window(text) <= 40 * 1.001);  // positions are written to a micrometre
    CHECK(gcode_fact(text, "worst segment rate [lines/s]") <= 40 * 1.0001);
    CHECK(gcode_fact(text, "slowed for the segment rate [mm]") > 0);
    CHECK(plane_moves(text).size() < plane_moves(free).size());
    CHECK(filament_of(plane_moves(text)) == Approx(filament_of(plane_moves(free))).epsilon(1e-4));
    // Long lines keep their speed.
    double fastest = 0;
    for (const PlaneMove& move : plane_moves(text))
        if (move.filament > 0) fastest = std::max(fastest, move.speed);
    CHECK(fastest == 100);
}

TEST_CASE("arcs carry the plastic of the points that they stand for", "[gcode][arcs]") {
    PrinterProfile profile = plain();
    const auto straight = plane_moves(print(profile));
    profile.gcode.arcs = true;
    const std::string text = print(profile);
    const auto moves = plane_moves(text);
    CHECK(10 * moves.size() < 7 * straight.size());
    CHECK(filament_of(moves) == Approx(filament_of(straight)).epsilon(1e-5));
    int arcs = 0;
    for (const PlaneMove& move : moves) {
        if (move.command != "G2" && move.command != "G3") continue;
        ++arcs;
        CHECK(move.filament > 0);
        // Cross-sections between those of the narrowest and the widest bead.
        const double area = move.filament * pi / 4 * 1.75 * 1.75 / move.length;
        CHECK(area > 0.01);
        CHECK(area < 1.3 * 0.45 * 0.2 * 1.01);
    }
    CHECK(arcs > 20);
    for (const GcodeLine& line : gcode_lines(text)) {
        CHECK(line.text.size() <= 95);
        if (line.has('I')) {
            CHECK(std::hypot(line.words.at('I'), line.words.at('J')) > 0.05);
            CHECK((line.has('X') && line.has('Y') && line.has('E')));
        }
    }
}

TEST_CASE("what slows and merges is continued byte for byte", "[gcode]") {
    const TemporaryFolder folder;
    PrinterProfile profile = plain();
    profile.gcode.lines_per_second = 40;
    profile.gcode.arcs = true;
    profile.gcode.min_layer_time = 5;
    profile.gcode.layer_script = "M117 {filament_used}";
    const int stop = GENERATE(0, 1, 9, 19);
    run_layers(cones(), *make_gcode(profile, folder / "parts", false), {0, 20}, false, stop);
    run_layers(cones(), *make_gcode(profile, folder / "parts", false), {0, 20}, true);
    CHECK(read_text(folder / "parts") == print(profile));
    PrinterProfile other = profile;
    other.gcode.layer_script = "M117 {layer}";
    run_layers(cones(), *make_gcode(profile, folder / "more", false), {0, 20}, false, stop);
    CHECK_THROWS_WITH(make_gcode(other, folder / "more", false)->open(cones(), {0, 20}, true),
                      Catch::Contains("other printer settings"));
}

TEST_CASE("the time that is told grows with slower machines", "[gcode]") {
    const auto seconds = [](const PrinterProfile& profile) {
        const std::string text = print(profile);
        const std::string key = "; estimated printing time (normal mode) = ";
        int m = 0, s = 0;
        REQUIRE(std::sscanf(text.c_str() + text.find(key) + key.size(), "%dm %ds", &m, &s) == 2);
        double nominal = 0;
        for (const PlaneMove& move : plane_moves(text)) nominal += move.length / move.speed;
        CHECK(60 * m + s >= nominal - 1);
        return 60 * m + s;
    };
    PrinterProfile profile = plain();
    profile.gcode.acceleration = 1e6;
    profile.gcode.junction_deviation = 1;
    const int quick = seconds(profile);
    profile.gcode.acceleration = 500;
    profile.gcode.junction_deviation = 0.01;
    CHECK(seconds(profile) > 1.2 * quick);
}

TEST_CASE("pictures stand in comments that are base64 of PNG files", "[gcode][thumbnail]") {
    // RFC 4648, section 10.
    CHECK(base64("") == "");
    CHECK(base64("f") == "Zg==");
    CHECK(base64("fo") == "Zm8=");
    CHECK(base64("foo") == "Zm9v");
    CHECK(base64("foob") == "Zm9vYg==");
    CHECK(base64("fooba") == "Zm9vYmE=");
    CHECK(base64("foobar") == "Zm9vYmFy");
    Job job = cones();
    job.picture = [](int size) {
        Picture picture{size, size, {}};
        for (int i = 0; i < 3 * size * size; ++i)
            picture.rgb.push_back(static_cast<std::uint8_t>(i % 251 * (i % 7)));
        return picture;
    };
    PrinterProfile profile = plain();
    profile.gcode.thumbnails = true;
    const std::string text = print(job, profile, {0, 1});
    std::size_t at = 0;
    for (const char* size : {"300x300", "32x32"}) {
        at = text.find(std::string("; thumbnail begin ") + size + " ", at);
        REQUIRE(at != std::string::npos);
        std::istringstream lines(text.substr(at));
        std::string line, body;
        std::getline(lines, line);
        const std::size_t said = std::stoul(line.substr(line.rfind(' ')));
        while (std::getline(lines, line) && line != "; thumbnail end") {
            CHECK(line.size() <= 80);
            body += line.substr(2);
        }
        CHECK(body.size() == said);
        CHECK(body.starts_with("iVBORw0KGgo"));  // the signature of PNG
    }
    profile.gcode.thumbnails = false;
    CHECK(print(job, profile, {0, 1}).find("thumbnail") == std::string::npos);
}

}  // namespace gcode_motion_test
