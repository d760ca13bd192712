// Several tools: which lays what, what is purged between them, and the same bytes however a job is made.
#include <catch2/catch.hpp>
#include <map>

#include "engine/layers/layer_stream.h"
#include "engine/layers/plate.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"
#include "printers/gcode/gcode.h"
#include "printers/toolpath/purge_tower.h"
#include "recipe/machine_profiles.h"
#include "tests/printers/common/plane_solids.h"
#include "tests/printers/gcode/gcode_lines.h"

namespace tool_change_test {

using namespace lamella;
using namespace lamella::test;

namespace {

constexpr double height = 0.2;

PrinterProfile two_tools() {
    PrinterProfile profile = MachineProfiles().find("marlin")->printer;
    profile.tools = {{"hard", 215, 0, 0, 0}, {"soft", 230, 235, 0, 1.1}};
    profile.toolpath.skirt = 0;
    return profile;
}

/// A block of 20 x 12 x 4 mm whose right half is made by tool 1, up to a height.
Job block(double soft_up_to = 4) {
    Job job;
    job.part = make_box({{0, 0, 0}, {20, 12, 4}});
    job.bounds = job.part->bounds();
    job.layers = {20, height};
    job.part_tools = {{0, nullptr}, {1, make_box({{10, -1, -1}, {21, 13, soft_up_to}})}};
    return job;
}

Job with_tower(Job job, const PrinterProfile& profile) {
    add_purge_tower(job, profile.purge, {200, 200});
    return job;
}

std::string written(const Job& job, const PrinterProfile& profile, int threads = 1) {
    const TemporaryFolder folder;
    StreamOptions options;
    options.range = {0, job.layers.count()};
    options.threads = threads;
    stream_layers(job, *make_gcode(profile, folder / "a.gcode", false), options);
    return read_text(folder / "a.gcode");
}

/// A straight extrusion with the tool that lays it, in the job's coordinates.
struct Laid {
    dvec2 from{0}, to{0};
    double volume = 0;  ///< mm^3
    int tool = 0, layer = -1;
    int changes = 0;  ///< of tools before it
    bool in_tower = false;
};

std::vector<Laid> laid(const std::string& text, const Job& job, const PrinterProfile& profile) {
    const dvec2 shift =
        dvec2(profile.filament.bed_x, profile.filament.bed_y) * 0.5 - dvec2(job.bounds.center());
    const double section = pi / 4 * profile.filament.filament * profile.filament.filament;
    std::vector<Laid> all;
    Laid now;
    std::string role;
    dvec2 at(0);
    for (const GcodeLine& line : gcode_lines(text)) {
        if (line.text == ";LAYER_CHANGE") ++now.layer;
        if (line.text.starts_with(";TYPE:")) role = line.text.substr(6);
        if (line.command.size() == 2 && line.command[0] == 'T') {
            now.tool = line.command[1] - '0';
            ++now.changes;
        }
        if (!line.has('X')) continue;
        now.from = at;
        at = now.to = dvec2(line.words.at('X'), line.words.at('Y')) - shift;
        if (line.command != "G1" || !line.has('E') || line.words.at('E') < 0 || now.layer < 0) continue;
        now.volume = line.words.at('E') * section;
        now.in_tower = role == "Wipe tower";
        all.push_back(now);
    }
    return all;
}

}  // namespace

TEST_CASE("each tool lays its own zone, whole", "[gcode][tools]") {
    const PrinterProfile profile = two_tools();
    const Job job = with_tower(block(), profile);
    std::map<int, double> volumes;
    for (const Laid& bead : laid(written(job, profile), job, profile)) {
        if (bead.in_tower) continue;
        volumes[bead.tool] += bead.volume;
        for (const dvec2 p : {bead.from, bead.to}) {
            CHECK(p.y > -0.01);
            CHECK(p.y < 12.01);
            CHECK((bead.tool == 0 ? p.x > -0.01 : p.x > 9.99));
            CHECK((bead.tool == 0 ? p.x < 10.01 : p.x < 20.01));
        }
    }
    REQUIRE(volumes.size() == 2);
    CHECK(volumes[0] == Approx(10 * 12 * 4).epsilon(0.002));
    CHECK(volumes[1] == Approx(10 * 12 * 4).epsilon(0.002));
}

TEST_CASE("a layer keeps the last one's tool, and every change is purged in the tower", "[gcode][tools]") {
    PrinterProfile profile = two_tools();
    profile.purge.volume = GENERATE(20.0, 60.0);
    const Job job = with_tower(block(), profile);
    const Box tower = job.purge_tower->bounds();
    CHECK(tower.size().x * tower.size().y * height == Approx(2 * profile.purge.volume));
    CHECK(intersect(tower, block().bounds).empty());
    const std::vector<Laid> beads = laid(written(job, profile), job, profile);
    std::map<int, double> purged;  // by change
    std::map<int, int> layers, first_in_tower;
    for (const Laid& bead : beads) {
        if (!layers.contains(bead.changes)) first_in_tower[bead.changes] = bead.in_tower ? 1 : 0;
        layers.emplace(bead.changes, bead.layer);
        if (!bead.in_tower) continue;
        purged[bead.changes] += bead.volume;
        CHECK(bead.to.x > tower.lo.x);
        CHECK(bead.to.x < tower.hi.x);
        CHECK(bead.to.y > tower.lo.y);
        CHECK(bead.to.y < tower.hi.y);
    }
    // The tool that is selected at the start is followed by one change in each layer.
    REQUIRE(layers.size() == 21);
    for (const auto& [change, layer] : layers) {
        if (change <= 1) continue;  // the one at the start
        INFO("change " << change);
        CHECK(layer == change - 2);
        CHECK(first_in_tower[change] == 1);
        CHECK(purged[change] > 0.998 * profile.purge.volume);
    }
}

TEST_CASE("the tower is whole in each layer up to the last change", "[gcode][tools]") {
    const PrinterProfile profile = two_tools();
    const Job job = with_tower(block(2), profile);
    CHECK(job.purge_tower->bounds().hi.z ==
          Approx(2.2));  // the hard tool may be changed to above the soft one
    std::map<int, double> volumes;
    std::map<int, int> last_change;
    for (const Laid& bead : laid(written(job, profile), job, profile)) {
        if (bead.in_tower) volumes[bead.layer] += bead.volume;
        last_change[bead.layer] = bead.changes;
    }
    REQUIRE(volumes.size() == 11);
    const dvec3 size = job.purge_tower->bounds().size();
    for (const auto& [layer, volume] : volumes) {
        INFO(layer);
        CHECK(volume > 0.2 * size.x * size.y * height);
        CHECK(volume < 1.01 * size.x * size.y * height);
    }
    CHECK(volumes[0] == Approx(size.x * size.y * height).epsilon(0.01));  // the first layer holds it
    CHECK(last_change[19] == last_change[10]);
}

TEST_CASE("temperatures and filament go by tool", "[gcode][tools]") {
    PrinterProfile profile = two_tools();
    profile.tools[0].standby_temperature = 170;
    const Job job = with_tower(block(), profile);
    const std::string text = written(job, profile);
    CHECK(text.find("\nM104 T0 S170\nT1\nM109 S235\n") != std::string::npos);
    CHECK(text.find("\nT0\nM109 S215\n") != std::string::npos);
    CHECK(text.find("\nT1\nM109 S230\n") != std::string::npos);
    CHECK(text.find("\nM104 T1 S0\n") != std::string::npos);
    const std::size_t used = text.find("; filament used [g] = ");
    REQUIRE(used != std::string::npos);
    const std::string grams = text.substr(used + 22, text.find('\n', used) - used - 22);
    const double section = pi / 4 * profile.filament.filament * profile.filament.filament / 1000;
    const double first = gcode_fact(text, "filament used [mm]");
    CHECK(std::stod(grams) == Approx(first * section * profile.support.density).margin(0.01));
    CHECK(grams.find(", ") != std::string::npos);
    profile.gcode.tool_script = "TOOL N={tool} FROM={previous_tool} TEMP={nozzle_temperature}";
    CHECK(written(job, profile).find("\nTOOL N=1 FROM=0 TEMP=230\n") != std::string::npos);
}

TEST_CASE("supports near the part are made by a tool of their own", "[gcode][tools]") {
    const PrinterProfile profile = two_tools();
    Job job = block();
    job.part_tools.clear();
    job.part = make_box({{0, 0, 3}, {20, 12, 4}});
    job.supports = make_box({{4, 4, 0}, {16, 8, 3}});
    job.support_tools = {{0, nullptr}, {1, make_box({{-1, -1, 2}, {21, 13, 5}})}};
    job = with_tower(std::move(job), profile);
    std::map<int, double> volumes;
    for (const Laid& bead : laid(written(job, profile), job, profile)) {
        if (!bead.in_tower) volumes[bead.tool] += bead.volume;
        if (bead.tool == 1 && !bead.in_tower) CHECK(bead.layer >= 10);
        if (bead.tool == 1 && !bead.in_tower) CHECK(bead.layer < 15);
    }
    CHECK(volumes[0] == Approx(20 * 12 * 1 + 12 * 4 * 2).epsilon(0.003));
    CHECK(volumes[1] == Approx(12 * 4 * 1).epsilon(0.003));
}

TEST_CASE("several tools give the same bytes by any number of threads, and resumed", "[gcode][tools]") {
    const PrinterProfile profile = two_tools();
    const Job job = with_tower(block(3), profile);
    const std::string text = written(job, profile);
    CHECK(written(job, profile, 4) == text);
    const TemporaryFolder folder;
    const std::string path = folder / "a.gcode";
    const LayerRange all{0, job.layers.count()};
    run_layers(job, *make_gcode(profile, path, false), all, false, 7);
    run_layers(job, *make_gcode(profile, path, false), all, true);
    CHECK(read_text(path) == text);
}

TEST_CASE("parts of a plate keep their tools", "[gcode][tools][plate]") {
    const PrinterProfile profile = two_tools();
    PlateOptions options;
    options.machine = {200, 150};
    Job plain = block();
    plain.part_tools.clear();
    const std::vector<PlateItem> items{{block(), 2}, {plain, 1}};
    Job plate = arrange_plates(items, options).front();
    add_purge_tower(plate, profile.purge, {200, 200});
    std::map<int, double> volumes;
    for (const Laid& bead : laid(written(plate, profile), plate, profile)) {
        if (!bead.in_tower) volumes[bead.tool] += bead.volume;
    }
    CHECK(volumes[0] == Approx(2 * 480 + 960).epsilon(0.002));
    CHECK(volumes[1] == Approx(2 * 480).epsilon(0.002));
}

}  // namespace tool_change_test
