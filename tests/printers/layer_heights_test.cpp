// Layers of several heights in every format: each says where a layer ends, or refuses what it cannot say.
#include "printers/common/layer_heights.h"

#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "engine/base/error.h"
#include "printers/gcode/gcode.h"
#include "printers/masks/goo.h"
#include "printers/masks/png_stack.h"
#include "printers/masks/resin.h"
#include "printers/masks/sl1.h"
#include "printers/readers/read_job.h"
#include "printers/registry.h"
#include "printers/vector/cli.h"
#include "printers/vector/slice_3mf.h"
#include "recipe/machine_profiles.h"
#include "tests/printers/archive/read_zip.h"
#include "tests/printers/common/plane_solids.h"

namespace layer_heights_test {

using namespace lamella;
using namespace lamella::test;

namespace {

const LayerPlan varied({{1, 0.3}, {3, 0.2}, {4, 0.1}, {2, 0.25}});
const std::vector<double> tops{0.3, 0.5, 0.7, 0.9, 1.0, 1.1, 1.2, 1.3, 1.55, 1.8};

/// A frustum of a cone, 1.8 mm high: its radius grows from 4 mm by as much as the height.
Job frustum(const LayerPlan& layers = varied) {
    Job job = make_job(
        {{-6, -6, 0}, {6, 6, 1.8}},
        [](double z) {
            return std::vector<Figure>{disc({0, 0}, 4 + z)};
        },
        0.1);
    job.layers = layers;
    return job;
}

double area_at(int layer) {
    const double radius = 4 + varied.middle(layer);
    return 3.14159265358979 * radius * radius;
}

PrinterProfile machine(const std::string& name) { return MachineProfiles().find(name)->printer; }

/// What follows a word in each line that begins with it.
std::vector<double> values_after(const std::string& text, const std::string& word) {
    std::vector<double> values;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);)
        if (line.starts_with(word)) values.push_back(std::stod(line.substr(word.size())));
    return values;
}

void check_tops(const std::vector<double>& found) {
    REQUIRE(found.size() == tops.size());
    for (std::size_t i = 0; i < tops.size(); ++i) CHECK(found[i] == Approx(tops[i]));
}

}  // namespace

TEST_CASE("G-code lifts by each layer's height, and extrudes for it", "[layers]") {
    const TemporaryFolder folder;
    PrinterProfile profile = machine("marlin");
    profile.filament.infill_density = 1;
    profile.toolpath.skirt = 0;
    const std::string path = folder / "a.gcode";
    const double volume = run_layers(frustum(), *make_gcode(profile, path, false), {0, 10});
    const std::string text = read_text(path);
    check_tops(values_after(text, ";Z:"));
    const std::vector<double> heights = values_after(text, ";HEIGHT:");
    double expected = 0;
    for (int i = 0; i < 10; ++i) {
        CHECK(heights[static_cast<std::size_t>(i)] == Approx(varied.height(i)));
        expected += area_at(i) * varied.height(i);
    }
    CHECK(volume == Approx(expected).epsilon(1e-3));
    // What the extruder feeds, layer by layer.
    const double section = 3.14159265358979 / 4 * profile.filament.filament * profile.filament.filament;
    std::size_t at = text.find(";LAYER_CHANGE");
    for (int i = 0; i < 10; ++i) {
        const std::size_t end = i < 9 ? text.find(";LAYER_CHANGE", at + 1) : text.find("; filament used");
        std::istringstream in(text.substr(at, end - at));
        double fed = 0;
        for (std::string line; std::getline(in, line);) {
            const std::size_t e = line.find(" E");
            if (line.starts_with("G1 ") && line.find(" X") != std::string::npos && e != std::string::npos)
                fed += std::stod(line.substr(e + 2));
        }
        INFO("layer " << i);
        CHECK(fed * section == Approx(area_at(i) * varied.height(i)).epsilon(0.02));
        at = end;
    }
}

TEST_CASE("contours and masks are told with their heights", "[layers]") {
    const TemporaryFolder folder;
    SECTION("CLI") {
        PrinterProfile profile = machine("powder-bed");
        profile.exchange.cli_format = CliFormat::ascii;
        profile.exchange.cli_empty_layer = false;
        profile.exchange.cli_units = 1;
        run_layers(frustum(), *make_cli(profile, folder / "a.cli", false), {0, 10});
        check_tops(values_after(read_text(folder / "a.cli"), "$$LAYER/"));
    }
    SECTION("GOO") {
        PrinterProfile profile = machine("elegoo-mars-4-ultra");
        profile.image.width = profile.image.height = 800;
        run_layers(frustum(), *make_goo(profile, folder / "a.goo", false), {0, 10});
        const std::string bytes = read_text(folder / "a.goo");
        const auto word_at = [&](std::size_t at) {
            std::uint32_t word = 0;
            for (std::size_t k = 0; k < 4; ++k)
                word = word << 8U | static_cast<unsigned char>(bytes.at(at + k));
            return word;
        };
        std::vector<double> found;
        std::size_t at = goo_header_size;
        for (int i = 0; i < 10; ++i) {
            // Two bytes and a number stand before a layer's height, 66 bytes before the size of its mask.
            found.push_back(std::bit_cast<float>(word_at(at + 6)));
            at += 66 + 4 + word_at(at + 66) + 2;
        }
        check_tops(found);
        CHECK(open_job(folder / "a.goo")->facts().heights == varied);
    }
    SECTION("slices in 3MF") {
        run_layers(frustum(), *make_slice_3mf(machine("powder-bed"), folder / "a.3mf", false), {0, 10});
        std::vector<double> found;
        for (const auto& [name, text] : read_zip(folder / "a.3mf")) {
            for (std::size_t at = text.find("ztop=\""); at != std::string::npos;
                 at = text.find("ztop=\"", at + 1))
                found.push_back(std::stod(text.substr(at + 6)));
        }
        check_tops(found);
    }
    SECTION("a stack of PNG") {
        PrinterProfile profile = machine("generic-4k");
        run_layers(frustum(), *make_png_stack(profile, folder / "png", false), {0, 10});
        const auto json = nlohmann::json::parse(read_text(folder / "png/job.json"));
        CHECK(json["layer_height"] == nlohmann::json{{1, 0.3}, {3, 0.2}, {4, 0.1}, {2, 0.25}});
        CHECK(open_job(folder / "png")->facts().heights == varied);
        run_layers(frustum(), *make_png_stack(profile, folder / "some", false), {2, 9});
        CHECK(open_job(folder / "some")->facts().heights == LayerPlan({{2, 0.2}, {4, 0.1}, {1, 0.25}}));
    }
    SECTION("SL1, whose first layer may differ") {
        const LayerPlan first({{1, 0.1}, {34, 0.05}});
        run_layers(frustum(first), *make_sl1(machine("prusa-sl1s"), folder / "a.sl1", false), {0, 35});
        std::string config;
        for (const auto& [name, text] : read_zip(folder / "a.sl1"))
            if (name == "config.ini") config = text;
        CHECK(values_after(config, "layerHeight = ") == std::vector<double>{0.05});
        CHECK(values_after(config, "layerHeightFirst = ") == std::vector<double>{0.1});
        CHECK(open_job(folder / "a.sl1")->facts().heights == first);
    }
}

namespace {

/// A resin in which light fades to 1/e over 0.1 mm, with 2 s for layers of 0.1 mm.
PrinterProfile fading(const std::string& name) {
    PrinterProfile profile = machine(name);
    profile.resin.exposure = 2;
    profile.resin.first_exposure = 20;
    profile.resin.first_layers = 2;
    profile.resin.fade_layers = 1;
    profile.resin.penetration = 0.1;
    profile.resin.exposure_height = 0.1;
    return profile;
}

double factor(double height) { return std::exp((height - 0.1) / 0.1); }

}  // namespace

TEST_CASE("exposures follow the heights of layers where a resin's penetration is known", "[layers]") {
    const TemporaryFolder folder;
    // Two first layers, one halfway between 20 and 2 s, and the others.
    const auto expected = [](int layer) {
        return (layer < 2 ? 20 : layer == 2 ? 11 : 2) * factor(varied.height(layer));
    };
    SECTION("print times") {
        const PrinterProfile profile = fading("elegoo-mars-4-ultra");
        for (const LayerRange range : {LayerRange{0, 10}, LayerRange{1, 9}, LayerRange{4, 5}}) {
            double seconds = 0;
            for (int i = range.first; i < range.last; ++i)
                seconds +=
                    resin_exposure(profile.resin, i - range.first, varied.height(i)) + profile.resin.moves;
            CHECK(resin_print_time(profile.resin, varied, range) == Approx(seconds));
        }
        for (int i = 0; i < 10; ++i)
            CHECK(resin_exposure(profile.resin, i, varied.height(i)) == Approx(expected(i)));
        // What is meant for layers of 0.1 mm holds for them.
        CHECK(resin_exposure(profile.resin, 5, 0.1) == Approx(2));
        ResinProfile even = profile.resin;
        even.penetration = 0;
        CHECK(resin_exposure(even, 5, 0.3) == 2);
    }
    SECTION("GOO, layer by layer") {
        PrinterProfile profile = fading("elegoo-mars-4-ultra");
        profile.image.width = profile.image.height = 800;
        run_layers(frustum(), *make_goo(profile, folder / "a.goo", false), {0, 10});
        const std::string bytes = read_text(folder / "a.goo");
        const auto word_at = [&](std::size_t at) {
            std::uint32_t word = 0;
            for (std::size_t k = 0; k < 4; ++k)
                word = word << 8U | static_cast<unsigned char>(bytes.at(at + k));
            return word;
        };
        std::size_t at = goo_header_size;
        for (int i = 0; i < 10; ++i) {
            CHECK(std::bit_cast<float>(word_at(at + 10)) == Approx(expected(i)));
            at += 66 + 4 + word_at(at + 66) + 2;
        }
    }
    SECTION("a stack of PNG, by runs of layers") {
        run_layers(frustum(), *make_png_stack(fading("generic-4k"), folder / "png", false), {0, 10});
        const auto json = nlohmann::json::parse(read_text(folder / "png/job.json"));
        REQUIRE(json["exposure"].size() == 4);
        for (std::size_t i = 0; i < 4; ++i) {
            const EqualLayers run = varied.runs()[i];
            CHECK(json["exposure"][i][0] == run.count);
            CHECK(json["exposure"][i][1].get<double>() == Approx(2 * factor(run.height)));
            CHECK(json["first_exposure"][i][1].get<double>() == Approx(20 * factor(run.height)));
        }
        CHECK_NOTHROW(open_job(folder / "png"));
    }
    SECTION("SL1, with a first layer of its own") {
        const LayerPlan first({{1, 0.1}, {34, 0.05}});
        run_layers(frustum(first), *make_sl1(fading("prusa-sl1s"), folder / "a.sl1", false), {0, 35});
        std::string config;
        for (const auto& [name, text] : read_zip(folder / "a.sl1"))
            if (name == "config.ini") config = text;
        CHECK(values_after(config, "expTime = ").at(0) == Approx(2 * factor(0.05)).margin(1e-4));
        CHECK(values_after(config, "expTimeFirst = ").at(0) == Approx(20));
    }
    SECTION("too long ones are refused") {
        PrinterProfile profile = fading("elegoo-mars-4-ultra");
        profile.resin.penetration = 0.01;
        CHECK_THROWS_WITH(make_goo(profile, folder / "a.goo", false)->open(frustum(), {0, 10}, false),
                          Catch::Contains("exposure of a layer of 0.3 mm (s)"));
    }
}

TEST_CASE("formats that know one height refuse several", "[layers]") {
    const TemporaryFolder folder;
    const LayerPlan first({{1, 0.1}, {34, 0.05}});
    for (const char* backend : {"ember", "nanodlp", "image3d", "dxf"}) {
        INFO(backend);
        PrinterProfile profile = machine("ember");
        profile.backend = backend;
        CHECK_THROWS_WITH(check_layer_heights(profile, first),
                          Catch::Contains("accepted: layers.height alone"));
        CHECK_NOTHROW(check_layer_heights(profile, LayerPlan(35, 0.05)));
    }
    PrinterProfile kerf = machine("laser-k40");
    CHECK_NOTHROW(check_layer_heights(kerf, first));  // outlines with their heights, for any use
    kerf.cutting.kerf = 0.1;
    for (const PrinterProfile& profile : {kerf, machine("grbl-laser")}) {
        CHECK_THROWS_AS(check_layer_heights(profile, first), InputError);
        const std::string path = folder / (profile.backend == kerf.backend ? "sheets" : "cut.nc");
        CHECK_THROWS_WITH(make_backend(profile, path, false)->open(frustum(), {0, 10}, false),
                          Catch::Contains("a sheet of material has layers of one height"));
    }
    CHECK_THROWS_WITH(
        make_sl1(machine("prusa-sl1s"), folder / "a.sl1", false)->open(frustum(), {0, 10}, false),
        Catch::Contains("accepted: layers.height and layers.first"));
    CHECK_NOTHROW(check_layer_heights(machine("prusa-sl1s"), first));
    CHECK_NOTHROW(check_layer_heights(machine("marlin"), varied));
    CHECK(equal_layer_height(varied, {1, 4}, "x") == 0.2);
    CHECK_THROWS_AS(equal_layer_height(varied, {0, 4}, "x"), InputError);
    CHECK_THROWS_AS(equal_layer_height(varied, {3, 5}, "x"), InputError);
}

}  // namespace layer_heights_test
