// SL1 archives hold the masks of a stack and what machine and programs ask for, and survive being stopped.
#include "printers/masks/sl1.h"

#include <catch2/catch.hpp>
#include <map>

#include "engine/base/error.h"
#include "engine/io/image_file.h"
#include "printers/masks/png_stack.h"
#include "printers/registry.h"
#include "tests/printers/archive/read_zip.h"
#include "tests/printers/common/plane_solids.h"

namespace sl1_test {

using namespace lamella;
using namespace lamella::test;

namespace {

/// A cone of discs, so that every layer differs.
Job cone(int layers = 20) {
    Job job = make_job(
        {{-6, -6, 0}, {6, 6, layers * 0.5}},
        [](double z) {
            return std::vector<Figure>{disc({0.3, -0.2}, 5.5 / (1 + z * 0.3))};
        },
        0.5);
    job.name = "a cone";
    return job;
}

PrinterProfile small_machine() {
    PrinterProfile profile;
    profile.name = "prusa-sl1s";
    profile.backend = "sl1";
    profile.image.pixel_x = profile.image.pixel_y = 0.05;
    profile.image.portrait = true;
    profile.resin.machine = "SL1S";
    profile.support = resin_supports();
    profile.image.width = 300;
    profile.image.height = 280;
    return profile;
}

std::map<std::string, std::string> read_lines(const std::string& text) {
    std::map<std::string, std::string> values;
    std::string last;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = text.find('\n', at), equals = text.find(" = ", at);
        REQUIRE(end != std::string::npos);
        REQUIRE(equals < end);
        const std::string key = text.substr(at, equals - at);
        CHECK(last < key);
        last = key;
        values[key] = text.substr(equals + 3, end - equals - 3);
        at = end + 1;
    }
    return values;
}

}  // namespace

TEST_CASE("an SL1 archive holds the masks of a stack", "[sl1]") {
    const TemporaryFolder folder;
    const double volume = run_layers(cone(), *make_sl1(small_machine(), folder / "a.sl1s", false), {0, 20});
    run_layers(cone(), *make_png_stack(small_machine(), folder / "stack", false), {0, 20});
    const auto entries = read_zip(folder / "a.sl1s");
    REQUIRE(entries.size() == 22);
    for (int k = 0; k < 20; ++k) {
        const std::string number = std::to_string(100000 + k).substr(1);
        CHECK(entries[static_cast<std::size_t>(k)].first == "a_cone" + number + ".png");
        CHECK(entries[static_cast<std::size_t>(k)].second ==
              read_text(folder / ("stack/" + number + ".png")));
    }
    CHECK(volume > 0);
    CHECK(entries[20].first == "config.ini");
    CHECK(entries[21].first == "prusaslicer.ini");
    const auto machine = read_lines(entries[20].second);
    CHECK(machine.at("action") == "print");
    CHECK(machine.at("jobDir") == "a_cone");
    CHECK(machine.at("printerModel") == "SL1S");
    CHECK(machine.at("layerHeight") == "0.5");
    CHECK(std::stoi(machine.at("numFast")) + std::stoi(machine.at("numSlow")) == 20);
    CHECK(std::stod(machine.at("usedMaterial")) == Approx(volume / 1000).margin(1e-5));
    // Three layers of 25 s, a ramp of ten between 25 and 2.5 s, seven of 2.5 s, and 6 s of moves each.
    CHECK(std::stod(machine.at("printTime")) == Approx(3 * 25 + 10 * 13.75 + 7 * 2.5 + 20 * 6));
    const auto display = read_lines(entries[21].second);
    CHECK(display.at("display_orientation") == "portrait");
    CHECK(display.at("display_mirror_x") == "1");
    CHECK(display.at("display_mirror_y") == "0");
    CHECK(display.at("display_pixels_x") == "300");
    CHECK(display.at("display_width") == "15");
    CHECK(display.at("printer_technology") == "SLA");
}

TEST_CASE("a stopped archive is continued to the same bytes", "[sl1]") {
    const TemporaryFolder folder;
    run_layers(cone(), *make_sl1(small_machine(), folder / "whole.sl1", false), {0, 20});
    for (const int stop : {0, 1, 7, 19}) {
        const std::string part = folder / ("part" + std::to_string(stop) + ".sl1");
        run_layers(cone(), *make_sl1(small_machine(), part, false), {0, 20}, false, stop);
        CHECK(!std::filesystem::exists(part));
        write_text(part + ".partial", read_text(part + ".partial") + "half a layer");
        run_layers(cone(), *make_sl1(small_machine(), part, false), {0, 20}, true);
        CHECK(read_text(part) == read_text(folder / "whole.sl1"));
    }
}

TEST_CASE("what an archive was begun with decides whether it is continued", "[sl1]") {
    const TemporaryFolder folder;
    const std::string path = folder / "a.sl1";
    run_layers(cone(), *make_sl1(small_machine(), path, false), {0, 20}, false, 5);
    PrinterProfile other = small_machine();
    other.resin.exposure = 3;
    CHECK_THROWS_WITH(make_sl1(other, path, false)->open(cone(), {0, 20}, true),
                      Catch::Contains("other printer settings"));
    write_text(path + ".partial", std::string(read_text(path + ".partial").size(), 'x'));
    CHECK_THROWS_WITH(make_sl1(small_machine(), path, false)->open(cone(), {0, 20}, true),
                      Catch::Contains("--force"));
}

TEST_CASE("an SL1 archive carries pictures of the part", "[sl1]") {
    const TemporaryFolder folder;
    Job job = cone();
    job.picture = [](int size) {
        Picture picture{size, size, {}};
        for (int i = 0; i < size * size; ++i) {
            const auto column = static_cast<std::uint8_t>(i % size % 256);
            picture.rgb.insert(picture.rgb.end(), {column, static_cast<std::uint8_t>(i / size % 256), 7});
        }
        return picture;
    };
    run_layers(job, *make_sl1(small_machine(), folder / "a.sl1s", false), {0, 20});
    const auto entries = read_zip(folder / "a.sl1s");
    REQUIRE(entries.size() == 24);
    CHECK(entries[22].first == "thumbnail/thumbnail400x400.png");
    CHECK(entries[23].first == "thumbnail/thumbnail800x480.png");
    for (const auto& [entry, width, height, left, top] :
         {std::tuple(22, 400, 400, 0, 0), std::tuple(23, 800, 480, 200, 40)}) {
        write_text(folder / "picture.png", entries[static_cast<std::size_t>(entry)].second);
        const auto image = open_images(folder / "picture.png");
        REQUIRE(image);
        const auto page = image->next_page();
        REQUIRE((page && page->width == width && page->height == height && page->channels == 3));
        std::vector<std::uint8_t> red(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
        std::vector<std::uint8_t> green(red.size());
        REQUIRE(image->read_channel(0, red.data()).empty());
        REQUIRE(image->read_channel(1, green.data()).empty());
        for (int row = 0; row < height; row += 13) {
            for (int column = 0; column < width; column += 11) {
                const auto at = static_cast<std::size_t>(row * width + column);
                CHECK(red[at] == std::clamp(column - left, 0, 399) % 256);
                CHECK(green[at] == std::clamp(row - top, 0, 399) % 256);
            }
        }
    }
    PrinterProfile without = small_machine();
    without.resin.preview = false;
    run_layers(job, *make_sl1(without, folder / "b.sl1s", false), {0, 20});
    CHECK(read_zip(folder / "b.sl1s").size() == 22);
}

TEST_CASE("no layer is called as the previews' folder begins", "[sl1]") {
    const TemporaryFolder folder;
    for (const auto& [name, begin] :
         {std::pair("t", "job-t00000.png"), std::pair("thumb", "job-thumb00000.png"),
          std::pair("", "job-00000.png"), std::pair("../x\n", "___x_00000.png"),
          std::pair("thumbnails", "thumbnails00000.png")}) {
        Job job = cone();
        job.name = name;
        const std::string path = folder / (std::string(begin) + ".sl1");
        run_layers(job, *make_sl1(small_machine(), path, false), {0, 3});
        CHECK(read_zip(path).front().first == begin);
    }
}

TEST_CASE("senseless exposures are refused", "[sl1]") {
    const TemporaryFolder folder;
    PrinterProfile profile = small_machine();
    for (const double exposure : {0.0, -1.0, 1e9, std::nan("")}) {
        profile.resin.exposure = exposure;
        CHECK_THROWS_AS(make_sl1(profile, folder / "a.sl1", false)->open(cone(), {0, 20}, false), InputError);
    }
}

}  // namespace sl1_test
