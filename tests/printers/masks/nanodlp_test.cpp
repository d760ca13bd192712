// NanoDLP archives: masks in colours, true figures of every layer, and stops that leave no trace.
#include "printers/masks/nanodlp.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "engine/base/error.h"
#include "printers/readers/read_job.h"
#include "tests/printers/archive/read_zip.h"
#include "tests/printers/masks/resin_job.h"

namespace nanodlp_test {

using namespace lamella;
using namespace lamella::test;

namespace {

std::map<std::string, std::string> entries_of(const std::string& path) {
    const auto list = read_zip(path);
    return {list.begin(), list.end()};
}

/// An image file's samples, all channels.
std::vector<unsigned char> samples(const std::string& file, int width, int height, int channels) {
    OIIO::Filesystem::IOMemReader memory(const_cast<char*>(file.data()), file.size());
    const auto input = OIIO::ImageInput::open("memory.png", nullptr, &memory);
    REQUIRE(input);
    CHECK(input->spec().width == width);
    CHECK(input->spec().height == height);
    REQUIRE(input->spec().nchannels == channels);
    std::vector<unsigned char> values(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                                      static_cast<std::size_t>(channels));
    REQUIRE(input->read_image(0, 0, 0, channels, OIIO::TypeDesc::UINT8, values.data()));
    return values;
}

}  // namespace

TEST_CASE("an archive for NanoDLP holds masks numbered from 1 and what they are", "[nanodlp]") {
    const TemporaryFolder folder;
    const PrinterProfile profile = small_machine("nanodlp");
    const double volume =
        run_layers(two_cones(), *make_nanodlp(profile, folder / "a.nanodlp", false), {0, 12});
    const auto entries = entries_of(folder / "a.nanodlp");
    CHECK(entries.size() == 12 + 6);
    const auto json = [&](const char* name) { return nlohmann::json::parse(entries.at(name)); };
    CHECK(json("meta.json")["Program"] == "Lamella");
    CHECK(json("plate.json")["LayersCount"] == 12);
    CHECK(json("plate.json")["TotalSolidArea"].get<double>() == Approx(volume / 1000).margin(1e-4));
    CHECK(json("profile.json")["Depth"] == 500);
    CHECK(json("profile.json")["CureTime"] == 2.5);
    CHECK(json("slicer.json")["PWidth"] == 280);
    CHECK(json("slicer.json")["PHeight"] == 300);
    CHECK(json("slicer.json")["XPixelSize"] == 0.05);
    CHECK(json("slicer.json") == json("options.json"));
}

TEST_CASE("the figures of a layer are those of its discs", "[nanodlp]") {
    const TemporaryFolder folder;
    PrinterProfile profile = small_machine("nanodlp");
    profile.image.portrait = false;
    run_layers(two_cones(), *make_nanodlp(profile, folder / "a.nanodlp", false), {0, 12});
    const auto info = nlohmann::json::parse(entries_of(folder / "a.nanodlp").at("info.json"));
    REQUIRE(info.size() == 12);
    for (int k = 0; k < 12; ++k) {
        const auto& layer = info[static_cast<std::size_t>(k)];
        const double radius = 4.2 / (1 + (k + 0.5) * 0.5 * 0.3);
        const bool both = k % 2 == 0;
        const double large = pi * radius * radius, small = both ? pi * 0.64 : large;
        INFO("layer " << k);
        CHECK(layer["AreaCount"] == (both ? 2 : 1));
        CHECK(layer["LargestArea"].get<double>() == Approx(std::max(large, small)).epsilon(0.004));
        CHECK(layer["SmallestArea"].get<double>() == Approx(std::min(large, small)).epsilon(0.004));
        CHECK(layer["TotalSolidArea"].get<double>() == Approx(both ? large + small : large).epsilon(0.004));
        // 300 x 280 px round (0, 0); rows count downwards.
        CHECK(layer["MinX"].get<double>() == Approx(150 + (-1.3 - radius) / 0.05).margin(1.01));
        CHECK(layer["MaxX"].get<double>() == Approx(150 + (both ? 5.4 : -1.3 + radius) / 0.05).margin(1.01));
        CHECK(layer["MinY"].get<double>() ==
              Approx(140 - std::max(both ? 3.9 : -9.0, -0.2 + radius) / 0.05).margin(1.01));
        CHECK(layer["MaxY"].get<double>() == Approx(140 + (0.2 + radius) / 0.05).margin(1.01));
    }
}

TEST_CASE("pixels stand in all colours, in one each, or in grey", "[nanodlp]") {
    PrinterProfile profile = small_machine("nanodlp");
    profile.image.portrait = false;
    const std::vector<DecodedImage> stack = stack_of(two_cones(3), profile);
    for (const PanelPixels pixels : {PanelPixels::rgb, PanelPixels::packed, PanelPixels::grey}) {
        const TemporaryFolder folder;
        profile.nanodlp.pixels = pixels;
        run_layers(two_cones(3), *make_nanodlp(profile, folder / "a.nanodlp", false), {0, 3});
        const auto entries = entries_of(folder / "a.nanodlp");
        const auto job = open_job(folder / "a.nanodlp");
        for (int k = 0; k < 3; ++k) {
            const std::vector<unsigned char>& greys = stack[static_cast<std::size_t>(k)].pixels;
            const std::string& file = entries.at(std::to_string(k + 1) + ".png");
            if (pixels == PanelPixels::packed) {
                CHECK(samples(file, 100, 280, 3) == greys);
            } else if (pixels == PanelPixels::grey) {
                CHECK(samples(file, 300, 280, 1) == greys);
            } else {
                std::vector<unsigned char> tripled;
                for (const unsigned char grey : greys) tripled.insert(tripled.end(), 3, grey);
                CHECK(samples(file, 300, 280, 3) == tripled);
            }
            CHECK(job->layer(k).pixels == greys);
        }
        CHECK(*job->facts().pixel_x == Approx(0.05));
    }
}

TEST_CASE("widths that colours do not take are refused before the first layer", "[nanodlp]") {
    const TemporaryFolder folder;
    PrinterProfile profile = small_machine("nanodlp");
    profile.image.portrait = false;
    profile.nanodlp.pixels = PanelPixels::packed;
    profile.image.width = 301;
    CHECK_THROWS_WITH(make_nanodlp(profile, folder / "a", false)->open(two_cones(), {0, 12}, false),
                      Catch::Contains("multiple of 3"));
    profile.nanodlp.pixels = PanelPixels::rgb;
    profile.image.width = 21846;
    CHECK_THROWS_WITH(make_nanodlp(profile, folder / "a", false)->open(two_cones(), {0, 12}, false),
                      Catch::Contains("21845 is the most"));
    CHECK(!std::filesystem::exists(folder / "a.partial"));
}

TEST_CASE("a stopped archive for NanoDLP is continued to the same bytes, more than once", "[nanodlp]") {
    const TemporaryFolder folder;
    const PrinterProfile profile = small_machine("nanodlp");
    run_layers(two_cones(), *make_nanodlp(profile, folder / "whole", false), {0, 12});
    for (const int stop : {0, 1, 5, 11}) {
        const std::string part = folder / ("part" + std::to_string(stop));
        run_layers(two_cones(), *make_nanodlp(profile, part, false), {0, 12}, false, stop);
        write_text(part + ".partial", read_text(part + ".partial") + "half a layer");
        run_layers(two_cones(), *make_nanodlp(profile, part, false), {0, 12}, true, std::min(stop + 3, 11));
        run_layers(two_cones(), *make_nanodlp(profile, part, false), {0, 12}, true);
        CHECK(read_text(part) == read_text(folder / "whole"));
    }
}

TEST_CASE("a range of layers is numbered from 1 as well", "[nanodlp]") {
    const TemporaryFolder folder;
    const PrinterProfile profile = small_machine("nanodlp");
    run_layers(two_cones(), *make_nanodlp(profile, folder / "whole", false), {0, 12});
    run_layers(two_cones(), *make_nanodlp(profile, folder / "some", false), {4, 8});
    const auto whole = entries_of(folder / "whole"), some = entries_of(folder / "some");
    CHECK(some.at("1.png") == whole.at("5.png"));
    CHECK(some.at("4.png") == whole.at("8.png"));
    CHECK(some.count("5.png") == 0);
    CHECK(nlohmann::json::parse(some.at("info.json"))[0] == nlohmann::json::parse(whole.at("info.json"))[4]);
}

}  // namespace nanodlp_test
