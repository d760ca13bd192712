// Ember archives are tape archives that `tar` unpacks, piece by piece made and continued.
#include "printers/masks/ember.h"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "engine/base/error.h"
#include "recipe/machine_profiles.h"
#include "tests/printers/masks/resin_job.h"

namespace ember_test {

using namespace lamella;
using namespace lamella::test;

namespace {

/// What `tar` finds in an archive.
std::map<std::string, std::string> unpacked(const std::string& path) {
    const TemporaryFolder folder;
    REQUIRE(std::system(
                ("tar -xzf " + path + " -C " + (folder / "") + " 2>" + (folder / "errors")).c_str()) == 0);
    CHECK(read_text(folder / "errors").empty());
    std::filesystem::remove(folder / "errors");
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder / ""))
        files[entry.path().filename().string()] = read_text(entry.path());
    return files;
}

}  // namespace

TEST_CASE("tar unpacks an archive for Ember into settings and slices", "[ember]") {
    const TemporaryFolder folder;
    const PrinterProfile profile = MachineProfiles().find("ember")->printer;
    run_layers(two_cones(), *make_ember(profile, folder / "a.tar.gz", false), {0, 12});
    run_layers(two_cones(), *make_png_stack(profile, folder / "stack", false), {0, 12});
    const auto files = unpacked(folder / "a.tar.gz");
    CHECK(files.size() == 12 + 2);
    for (int k = 0; k < 12; ++k) {
        const std::string number = std::to_string(100000 + k).substr(1);
        CHECK(files.at("slice_" + std::to_string(k + 1) + ".png") ==
              read_text(folder / ("stack/" + number + ".png")));
    }
    const auto settings = nlohmann::json::parse(files.at("printsettings"))["Settings"];
    CHECK(settings["JobName"] == "two cones");
    CHECK(settings["LayerThicknessMicrons"] == 500);
    CHECK(settings["LayerThicknessMicrons"].is_number_integer());
    CHECK(settings["BurnInLayers"] == 3);
    CHECK(settings["FirstExposureSec"] == 25);
    CHECK(settings["BurnInExposureSec"] == 25);
    CHECK(settings["ModelExposureSec"] == 2.5);
    // Layers count from 1: the first four have their own exposure, ten fade, of which eight exist.
    const std::string& fading = files.at("layersettings.csv");
    CHECK(fading.starts_with("Layer,ModelExposureSec\r\n5,22.9545\r\n6,20.9091\r\n"));
    CHECK(fading.ends_with("\r\n12,8.6364\r\n"));
}

TEST_CASE("exposures that do not fade need no settings of layers", "[ember]") {
    const TemporaryFolder folder;
    PrinterProfile profile = MachineProfiles().find("ember")->printer;
    profile.resin.fade_layers = 0;
    run_layers(two_cones(2), *make_ember(profile, folder / "a.tar.gz", false), {0, 2});
    CHECK(unpacked(folder / "a.tar.gz").count("layersettings.csv") == 0);
}

TEST_CASE("a stopped archive for Ember is continued to the same bytes", "[ember]") {
    const TemporaryFolder folder;
    const PrinterProfile profile = MachineProfiles().find("ember")->printer;
    run_layers(two_cones(), *make_ember(profile, folder / "whole", false), {0, 12});
    for (const int stop : {0, 1, 7, 11}) {
        const std::string part = folder / ("part" + std::to_string(stop));
        run_layers(two_cones(), *make_ember(profile, part, false), {0, 12}, false, stop);
        write_text(part + ".partial", read_text(part + ".partial") + "half a layer");
        run_layers(two_cones(), *make_ember(profile, part, false), {0, 12}, true);
        CHECK(read_text(part) == read_text(folder / "whole"));
    }
}

TEST_CASE("what an Ember cannot print is refused", "[ember]") {
    const TemporaryFolder folder;
    PrinterProfile profile = MachineProfiles().find("ember")->printer;
    Job job = two_cones();
    job.layers = {12, 0.0333};
    CHECK_THROWS_WITH(make_ember(profile, folder / "a", false)->open(job, {0, 12}, false),
                      Catch::Contains("whole micrometres"));
    profile.image.width = 1920;
    CHECK_THROWS_WITH(make_ember(profile, folder / "a", false)->open(two_cones(), {0, 12}, false),
                      Catch::Contains("1280 x 800"));
    CHECK(!std::filesystem::exists(folder / "a.partial"));
}

}  // namespace ember_test
