// Labels of parts: every line that extrudes lies on the part that was announced, in each dialect.
#include "printers/gcode/object_labels.h"

#include <catch2/catch.hpp>
#include <map>
#include <sstream>

#include "engine/layers/plate.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"
#include "printers/gcode/gcode.h"
#include "recipe/machine_profiles.h"
#include "tests/printers/common/plane_solids.h"

namespace object_labels_test {

using namespace lamella;
using namespace lamella::test;

namespace {

/// Three copies of a part of two posts, with a support between them.
Job plate_of_three() {
    Job job;
    job.name = "two posts";
    job.part = make_union({make_box({{0, 0, 0}, {6, 6, 2}}), make_box({{12, 0, 0}, {18, 6, 2}})});
    job.supports = make_box({{8, 0, 0}, {10, 6, 2}});
    job.bounds = {{0, 0, 0}, {18, 6, 2}};
    job.layers = {10, 0.2};
    PlateOptions options;
    options.machine = {100, 100};
    const PlateItem item{job, 3};
    return arrange_plates({&item, 1}, options).front();
}

std::string written(const Job& job, Flavour flavour, bool labels = true) {
    const TemporaryFolder folder;
    PrinterProfile profile = MachineProfiles().find("marlin")->printer;
    profile.gcode.flavour = flavour;
    profile.gcode.label_objects = labels;
    run_layers(job, *make_gcode(profile, folder / "a.gcode", false), {0, 10});
    return read_text(folder / "a.gcode");
}

/// Where lines extrude by the part that was announced, without skirt and prime line.
std::map<std::string, Rect> extruded(const std::string& text) {
    std::map<std::string, Rect> places;
    std::istringstream in(text);
    std::string object, role;
    for (std::string line; std::getline(in, line);) {
        if (line.starts_with(";TYPE:")) role = line.substr(6);
        if (line.starts_with("EXCLUDE_OBJECT_START NAME=")) object = line.substr(26);
        if (line.starts_with("EXCLUDE_OBJECT_END")) object.clear();
        if (line.starts_with("M486 S")) object = line == "M486 S-1" ? "" : line.substr(6, 1);
        const std::size_t e = line.find(" E"), x = line.find(" X"), y = line.find(" Y");
        if (!line.starts_with("G1 ") || x == std::string::npos || y == std::string::npos ||
            e == std::string::npos)
            continue;
        if (line[e + 2] == '-' || role == "Custom" || role == "Skirt/Brim") continue;
        const dvec2 at(std::stod(line.substr(x + 2)), std::stod(line.substr(y + 2)));
        places[object] = unite(places[object], Rect{at, at});
    }
    return places;
}

}  // namespace

TEST_CASE("what is extruded lies on the part that is announced", "[gcode][plate]") {
    const Job plate = plate_of_three();
    REQUIRE(plate.objects.size() == 3);
    const Flavour flavour = GENERATE(Flavour::marlin, Flavour::klipper, Flavour::reprapfirmware);
    const std::string text = written(plate, flavour);
    const auto places = extruded(text);
    REQUIRE(places.size() == 3);
    CHECK(!places.contains(""));
    for (const auto& [name, rect] : places) {
        INFO(name);
        CHECK(rect.size().x > 17);
        CHECK(rect.size().x < 18.1);
        CHECK(rect.size().y < 6.1);
        for (const auto& [other, away] : places) {
            if (other != name) CHECK(intersect(rect, away).empty());
        }
    }
    if (flavour == Flavour::klipper) {
        CHECK(places.contains("two_posts_1"));
        CHECK(text.find("EXCLUDE_OBJECT_DEFINE NAME=two_posts_3 CENTER=") != std::string::npos);
    } else {
        CHECK(text.find("M486 T3\n") != std::string::npos);
    }
    if (flavour == Flavour::reprapfirmware)
        CHECK(text.find("M486 S2 A\"two_posts_3\"\n") != std::string::npos);
}

TEST_CASE("labels change nothing else, and a single part has none", "[gcode][plate]") {
    const Job plate = plate_of_three();
    std::string kept;
    std::istringstream in(written(plate, Flavour::marlin));
    for (std::string line; std::getline(in, line);)
        if (!line.starts_with("M486")) kept += line + "\n";
    const std::string plain = written(plate, Flavour::marlin, false);
    CHECK(plain.find("M486") == std::string::npos);
    CHECK(kept == plain);
    Job alone = plate;
    alone.objects.clear();
    CHECK(written(alone, Flavour::marlin) == plain);
}

}  // namespace object_labels_test
