// The PNG stack shows the right area at the right place and the right way round, and survives being stopped.
#include "printers/masks/png_stack.h"

#include <fmt/format.h>
#include <signal.h>
#include <sys/resource.h>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <numbers>

#include "engine/base/error.h"
#include "engine/io/image_file.h"
#include "tests/printers/common/plane_solids.h"
#include "tests/printers/masks/decode_image.h"
#include "tests/printers/toolpath/supported_table.h"

namespace png_stack_test {

using namespace lamella;
using namespace lamella::test;
namespace fs = std::filesystem;

namespace {

/// An L on the plate: a long leg along +x at the bottom, a short one along +y at the left.
Job asymmetric_l() {
    const Box bounds{{10, 20, 5}, {18, 24, 6}};
    return make_job(
        bounds,
        [](double) {
            return std::vector<Figure>{rectangle({10, 20}, {18, 21}), rectangle({10, 20}, {11, 24})};
        },
        0.25);
}

/// A cone of discs, so that every layer differs.
Job cone(int layers = 12) {
    const Box bounds{{-6, -6, 0}, {6, 6, layers * 0.5}};
    return make_job(
        bounds,
        [](double z) {
            return std::vector<Figure>{disc({0.3, -0.2}, 5.5 / (1 + z * 0.3))};
        },
        0.5);
}

PrinterProfile small_display() {
    PrinterProfile profile;
    profile.image.width = 200;
    profile.image.height = 160;
    profile.image.pixel_x = 0.1;
    profile.image.pixel_y = 0.1;
    return profile;
}

/// A point of the image, taken from the centre outwards: +1 right or down of it.
int grey_at(const DecodedImage& image, double right, double down) {
    return image.at(static_cast<int>(image.width / 2.0 + right), static_cast<int>(image.height / 2.0 + down));
}

std::vector<std::string> names_in(const fs::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder))
        names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

}  // namespace

TEST_CASE("an L keeps its corners and area on every kind of display", "[png_stack]") {
    const bool portrait = GENERATE(false, true);
    const bool mirror_x = GENERATE(false, true);
    const bool mirror_y = GENERATE(false, true);
    CAPTURE(portrait, mirror_x, mirror_y);
    const TemporaryFolder folder;
    PrinterProfile profile = small_display();
    profile.image.pixel_x = 0.1;
    profile.image.pixel_y = 0.05;
    profile.image.portrait = portrait;
    profile.image.mirror_x = mirror_x;
    profile.image.mirror_y = mirror_y;
    const Job job = asymmetric_l();
    const auto backend = make_png_stack(profile, folder / "out", false);
    const double volume = run_layers(job, *backend, {0, 4});
    CHECK(volume == Approx(8 + 3));

    const DecodedImage image = decode_image(folder / "out/00002.png");
    CHECK(image.width == (portrait ? 160 : 200));
    CHECK(image.height == (portrait ? 200 : 160));
    CHECK(image.filled() * 0.1 * 0.05 == Approx(11).epsilon(1e-3));
    // The part's corners, as offsets from its centre in mm: three are solid, (+4, +2) is not.
    for (const double x : {-3.7, 3.7}) {
        for (const double y : {-1.7, 1.7}) {
            // Landscape: right is +x, up is +y. Portrait: right is +y, up is +x. Then the mirrors.
            double right = portrait ? y / 0.05 : x / 0.1;
            double down = portrait ? -x / 0.1 : -y / 0.05;
            if (mirror_x) right = -right;
            if (mirror_y) down = -down;
            CHECK(grey_at(image, right, down) == (x > 0 && y > 0 ? 0 : 255));
        }
    }
    CHECK(image.pixels_per_metre_x == (portrait ? 20000 : 10000));
    CHECK(image.pixels_per_metre_y == (portrait ? 10000 : 20000));
}

TEST_CASE("masks of discs have the area of discs", "[png_stack]") {
    const auto antialiasing = GENERATE(Antialiasing::off, Antialiasing::rows, Antialiasing::exact);
    CAPTURE(static_cast<int>(antialiasing));
    const TemporaryFolder folder;
    PrinterProfile profile = small_display();
    profile.image.antialiasing = antialiasing;
    const Job job = cone();
    run_layers(job, *make_png_stack(profile, folder / "out", false), {0, job.layers.count()});
    const double tolerance = antialiasing == Antialiasing::off ? 0.02 : 0.003;
    for (int i = 0; i < job.layers.count(); ++i) {
        const double radius = 5.5 / (1 + job.plane(i) * 0.3);
        char name[32];
        std::snprintf(name, sizeof name, "out/%05d.png", i);
        const DecodedImage image = decode_image(folder / name);
        CHECK(image.filled() * 0.01 == Approx(3.14159265358979 * radius * radius).epsilon(tolerance));
        if (antialiasing == Antialiasing::off) {
            CHECK(std::all_of(image.pixels.begin(), image.pixels.end(),
                              [](unsigned char grey) { return grey == 0 || grey == 255; }));
        }
        const auto product = [&] {
            auto backend = make_png_stack(profile, folder / "again", true);
            backend->open(job, {0, job.layers.count()}, true);
            return backend->render(Layer(job, i));
        }();
        CHECK(product->area == Approx(3.14159265358979 * radius * radius).epsilon(tolerance));
    }
}

TEST_CASE("every image format holds the pixels of the PNG", "[png_stack]") {
    const TemporaryFolder folder;
    const Job job = cone();
    PrinterProfile profile = small_display();
    run_layers(job, *make_png_stack(profile, folder / "png", false), {0, job.layers.count()});
    const DecodedImage expected = decode_image(folder / "png/00001.png");
    for (const auto& [format, ending] :
         {std::pair{ImageFormat::tiff, "tif"}, {ImageFormat::bmp, "bmp"}, {ImageFormat::pgm, "pgm"}}) {
        INFO(ending);
        profile.image.format = format;
        run_layers(job, *make_png_stack(profile, folder / ending, false), {0, job.layers.count()});
        const auto input = OIIO::ImageInput::open(folder / (std::string(ending) + "/00001." + ending));
        REQUIRE(input);
        REQUIRE(input->spec().width == expected.width);
        REQUIRE(input->spec().height == expected.height);
        // A grey BMP comes back as equal channels of colour.
        const auto channels = static_cast<std::size_t>(input->spec().nchannels);
        std::vector<unsigned char> pixels(expected.pixels.size() * channels);
        REQUIRE(input->read_image(0, 0, 0, input->spec().nchannels, OIIO::TypeDesc::UINT8, pixels.data()));
        std::size_t wrong = 0;
        for (std::size_t k = 0; k < pixels.size(); ++k)
            wrong += pixels[k] != expected.pixels[k / channels] ? 1 : 0;
        REQUIRE(wrong == 0);
    }
}

TEST_CASE("a BMP says how large its pixels are", "[png_stack]") {
    const TemporaryFolder folder;
    PrinterProfile profile = small_display();
    profile.image.format = ImageFormat::bmp;
    profile.image.pixel_x = 25.4 / 600;
    profile.image.pixel_y = 25.4 / 300;
    profile.image.width = 400;
    run_layers(cone(), *make_png_stack(profile, folder / "out", false), {0, 1});
    const std::string file = read_text(folder / "out/00000.bmp");
    const auto number = [&](std::size_t at) {
        std::uint32_t value = 0;
        for (std::size_t i = 4; i-- > 0;) value = value << 8U | static_cast<unsigned char>(file.at(at + i));
        return value;
    };
    CHECK(number(38) == 23622);  // an inch is 25.4 mm
    CHECK(number(42) == 11811);
}

TEST_CASE("job.json says what the images are", "[png_stack]") {
    const TemporaryFolder folder;
    const Job job = asymmetric_l();
    run_layers(job, *make_png_stack(small_display(), folder / "out/", false), {1, 4});
    CHECK(names_in(folder / "out") ==
          std::vector<std::string>{"00001.png", "00002.png", "00003.png", "job.json"});
    const auto json = nlohmann::json::parse(read_text(folder / "out/job.json"));
    CHECK(json["format"] == "lamella-layers");
    CHECK(json["version"] == 1);
    CHECK(json["identity"] == job.identity);
    CHECK(json["layer_count"] == 4);
    CHECK(json["first_layer"] == 1);
    CHECK(json["last_layer"] == 4);
    CHECK(json["layer_height"] == 0.25);
    CHECK(json["width"] == 200);
    CHECK(json["pixel_x"] == 0.1);
    CHECK(json["files"] == "%05d.png");
    CHECK(json["first_plane"] == Approx(0.125));
    // The part's lower left corner (10, 20) is where the placement says: 40 columns left of the middle.
    const auto& placement = json["placement"];
    const double column =
        (10 - placement["column_0_edge"].get<double>()) / placement["column_step"].get<double>();
    const double row = (20 - placement["row_0_edge"].get<double>()) / placement["row_step"].get<double>();
    CHECK(column == Approx(60));
    CHECK(row == Approx(100));
}

TEST_CASE("masks of one bit are those in black and white", "[png_stack]") {
    const TemporaryFolder folder;
    PrinterProfile profile = small_display();
    profile.image.antialiasing = Antialiasing::off;
    for (const int width : {200, 203, 121}) {
        CAPTURE(width);
        profile.image.width = width;
        const std::string name = std::to_string(width);
        profile.image.bits = 8;
        run_layers(cone(), *make_png_stack(profile, folder / (name + "-8"), false), {0, 12});
        profile.image.bits = 1;
        run_layers(cone(), *make_png_stack(profile, folder / (name + "-1"), false), {0, 12});
        for (int layer = 0; layer < 12; ++layer) {
            const std::string file = "/" + std::to_string(100000 + layer).substr(1) + ".png";
            // Bits a sample stand behind signature, length, "IHDR", width and height.
            CHECK(read_text(folder / (name + "-1" + file))[24] == 1);
            const DecodedImage bits = decode_image(folder / (name + "-1" + file));
            CHECK(bits.width == width);
            CHECK(bits.pixels == decode_image(folder / (name + "-8" + file)).pixels);
        }
    }
    profile.image.antialiasing = Antialiasing::rows;
    CHECK_THROWS_WITH(make_png_stack(profile, folder / "grey", false)->open(cone(), {0, 12}, false),
                      Catch::Contains("antialiasing = \"off\""));
    profile.image.bits = 4;
    CHECK_THROWS_AS(make_png_stack(profile, folder / "four", false)->open(cone(), {0, 12}, false),
                    InputError);
    profile.image.bits = 16;
    profile.image.format = ImageFormat::bmp;
    CHECK_THROWS_WITH(make_png_stack(profile, folder / "bmp", false)->open(cone(), {0, 12}, false),
                      Catch::Contains("bits = 8"));
}

TEST_CASE("masks of sixteen bits tell coverage more finely", "[png_stack]") {
    const TemporaryFolder folder;
    const Antialiasing antialiasing = GENERATE(Antialiasing::rows, Antialiasing::exact);
    PrinterProfile profile = small_display();
    profile.image.antialiasing = antialiasing;
    profile.image.sub_rows = 32;
    // Edges through pixels at shares that 8 bits cannot tell: 0.3010 and 0.7003 of a pixel.
    const Job box = make_job(
        {{0, 0, 0}, {8, 4, 1}},
        [](double) {
            return std::vector<Figure>{rectangle({0.03010, 0}, {7.97003, 4})};
        },
        0.5);
    run_layers(box, *make_png_stack(profile, folder / "eight", false), {0, 2});
    profile.image.bits = 16;
    run_layers(box, *make_png_stack(profile, folder / "sixteen", false), {0, 2});
    const DecodedImage eight = decode_image(folder / "eight/00001.png");
    const auto image = open_images(folder / "sixteen/00001.png");
    REQUIRE(image);
    const auto page = image->next_page();
    REQUIRE((page && page->samples == SampleType::u16 && page->width == 200 && page->height == 160));
    std::vector<std::uint16_t> sixteen(eight.pixels.size());
    REQUIRE(image->read_channel(0, sixteen.data()).empty());
    for (std::size_t i = 0; i < sixteen.size(); ++i)
        REQUIRE(std::abs(sixteen[i] / 65535.0 - eight.pixels[i] / 255.0) <= 0.5 / 255 + 1.0 / 65535);
    // Runs are exact to 1/256 of a pixel.
    const std::size_t row = 200 * 80;
    CHECK(sixteen[row + 60] / 65535.0 == Approx(1 - 0.3010).margin(0.5 / 256 + 1e-5));
    CHECK(sixteen[row + 139] / 65535.0 == Approx(0.7003).margin(0.5 / 256 + 1e-5));
    CHECK(sixteen[row + 100] == 65535);
}

TEST_CASE("a part larger than the display is refused with both sizes", "[png_stack]") {
    const TemporaryFolder folder;
    PrinterProfile profile = small_display();
    profile.image.width = 70;
    const auto backend = make_png_stack(profile, folder / "out", false);
    CHECK_THROWS_WITH(backend->open(asymmetric_l(), {0, 4}, false),
                      Catch::Contains("8.000 x 4.000 mm") && Catch::Contains("7.000 x 16.000 mm"));
    CHECK(!fs::exists(folder / "out.partial"));
    profile.image.width = 80;  // exactly as long as the part
    run_layers(asymmetric_l(), *make_png_stack(profile, folder / "fits", false), {0, 4});
    CHECK(decode_image(folder / "fits/00000.png").filled() * 0.01 == Approx(11).epsilon(1e-3));
}

TEST_CASE("senseless displays and ranges are refused", "[png_stack]") {
    const TemporaryFolder folder;
    const Job job = asymmetric_l();
    const auto begin = [&](auto change, LayerRange range = {0, 4}) {
        PrinterProfile profile = small_display();
        change(profile.image);
        make_png_stack(profile, folder / "out", false)->open(job, range, false);
    };
    CHECK_THROWS_AS(begin([](ImageProfile& i) { i.width = 0; }), InputError);
    CHECK_THROWS_AS(begin([](ImageProfile& i) { i.height = 65536; }), InputError);
    CHECK_THROWS_AS(begin([](ImageProfile& i) { i.pixel_x = 0; }), InputError);
    CHECK_THROWS_AS(begin([](ImageProfile& i) { i.pixel_y = std::nan(""); }), InputError);
    CHECK_THROWS_AS(begin([](ImageProfile& i) { i.sub_rows = 0; }), InputError);
    CHECK_THROWS_AS(begin([](ImageProfile&) {}, {0, 5}), InputError);
    CHECK_THROWS_AS(begin([](ImageProfile&) {}, {2, 2}), InputError);
    CHECK_THROWS_AS(begin([](ImageProfile&) {}, {-1, 2}), InputError);
    CHECK_THROWS_AS(make_png_stack(small_display(), "", false), InputError);
}

TEST_CASE("a stopped stack is continued and equals one made in one go", "[png_stack]") {
    const TemporaryFolder folder;
    const Job job = cone();
    run_layers(job, *make_png_stack(small_display(), folder / "whole", false), {0, 12});
    run_layers(job, *make_png_stack(small_display(), folder / "parts", false), {0, 12}, false, 5);
    CHECK(!fs::exists(folder / "parts"));
    CHECK(fs::exists(folder / "parts.partial/00004.png"));
    // A layer that was being written when the run stopped does not count.
    write_text(folder / "parts.partial/00005.png.tmp", "half a file");
    const auto again = make_png_stack(small_display(), folder / "parts", false);
    CHECK(again->open(job, {0, 12}, true) == 5);
    run_layers(job, *again, {0, 12}, true);
    CHECK(!fs::exists(folder / "parts.partial"));
    CHECK(names_in(folder / "parts") == names_in(folder / "whole"));
    for (const std::string& name : names_in(folder / "whole")) {
        INFO(name);
        CHECK(read_text(fs::path(folder / "parts") / name) == read_text(fs::path(folder / "whole") / name));
    }
}

TEST_CASE("job.json has every layer's area, those of an earlier run included", "[png_stack]") {
    const TemporaryFolder folder;
    const Job job = cone();
    run_layers(job, *make_png_stack(small_display(), folder / "out", false), {2, 12}, false, 5);
    // Half a line was written when the machine went down: its layer is made again.
    const fs::path journal = fs::path(folder / "out.partial") / "unfinished.layers";
    write_text(journal, read_text(journal).substr(0, read_text(journal).size() - 4));
    CHECK(make_png_stack(small_display(), folder / "out", false)->open(job, {2, 12}, true) == 4);
    run_layers(job, *make_png_stack(small_display(), folder / "out", false), {2, 12}, true);
    const auto json = nlohmann::json::parse(read_text(folder / "out/job.json"));
    REQUIRE(json["areas"].size() == 10);
    CHECK(!json.contains("support_areas"));
    for (int layer = 2; layer < 12; ++layer) {
        const double radius = 5.5 / (1 + (layer + 0.5) * 0.5 * 0.3);
        CHECK(json["areas"][static_cast<std::size_t>(layer - 2)].get<double>() ==
              Approx(std::numbers::pi * radius * radius).epsilon(2e-3));
    }
    CHECK(json["exposure"] == small_display().resin.exposure);
}

TEST_CASE("a folder without a stamp or a layer is begun anew", "[png_stack]") {
    const TemporaryFolder folder;
    fs::create_directories(folder / "out.partial");
    write_text(folder / "out.partial/unfinished.json.tmp", "{");
    CHECK(make_png_stack(small_display(), folder / "out", false)->open(cone(), {0, 12}, true) == 0);
}

TEST_CASE("a run that died just before its folder got its name is made anew", "[png_stack]") {
    const TemporaryFolder folder;
    run_layers(cone(), *make_png_stack(small_display(), folder / "whole", false), {0, 12});
    fs::copy(folder / "whole", folder / "out.partial");
    CHECK_THROWS_AS(make_png_stack(small_display(), folder / "out", false)->open(cone(), {0, 12}, false),
                    InputError);
    run_layers(cone(), *make_png_stack(small_display(), folder / "out", false), {0, 12}, true);
    CHECK(read_text(folder / "out/job.json") == read_text(folder / "whole/job.json"));
    CHECK(!fs::exists(folder / "out.partial"));
}

TEST_CASE("shards hold the files of the whole", "[png_stack]") {
    const TemporaryFolder folder;
    const Job job = cone();
    run_layers(job, *make_png_stack(small_display(), folder / "whole", false), {0, 12});
    run_layers(job, *make_png_stack(small_display(), folder / "a", false), {0, 7});
    run_layers(job, *make_png_stack(small_display(), folder / "b", false), {7, 12});
    for (const std::string& name : names_in(folder / "whole")) {
        if (name == "job.json") continue;
        const std::string shard = name < "00007" ? "a" : "b";
        CHECK(read_text(fs::path(folder / shard) / name) == read_text(fs::path(folder / "whole") / name));
    }
}

TEST_CASE("what another job began is not continued", "[png_stack]") {
    const TemporaryFolder folder;
    Job job = cone();
    const auto begin = [&](const PrinterProfile& profile, LayerRange range, bool resume, bool force) {
        return make_png_stack(profile, folder / "out", force)->open(job, range, resume);
    };
    run_layers(job, *make_png_stack(small_display(), folder / "out", false), {0, 12}, false, 5);
    CHECK_THROWS_WITH(begin(small_display(), {0, 12}, false, false), Catch::Contains("--resume"));
    CHECK_THROWS_WITH(begin(small_display(), {0, 11}, true, false), Catch::Contains("layers 0:12, not 0:11"));
    PrinterProfile other = small_display();
    other.image.mirror_x = true;
    CHECK_THROWS_WITH(begin(other, {0, 12}, true, false), Catch::Contains("mirror_x"));
    job.identity = "another";
    CHECK_THROWS_WITH(begin(small_display(), {0, 12}, true, false), Catch::Contains("another job"));
    CHECK(begin(small_display(), {0, 12}, false, true) == 0);
    CHECK(names_in(folder / "out.partial") ==
          std::vector<std::string>{"unfinished.json", "unfinished.layers"});
    write_text(folder / "out.partial/unfinished.json", "{\"broken");
    CHECK_THROWS_AS(begin(small_display(), {0, 12}, true, false), InputError);
    write_text(folder / "out.partial/unfinished.json", "[1]");
    CHECK_THROWS_AS(begin(small_display(), {0, 12}, true, false), InputError);
}

TEST_CASE("a finished stack is replaced only when told, and only when it is ours", "[png_stack]") {
    const TemporaryFolder folder;
    const Job job = cone();
    const auto run = [&](bool force, LayerRange range) {
        run_layers(job, *make_png_stack(small_display(), folder / "out", force), range);
    };
    run(false, {0, 12});
    CHECK_THROWS_WITH(run(false, {0, 3}), Catch::Contains("exists already"));
    run(true, {0, 3});
    CHECK(names_in(folder / "out").size() == 4);
    CHECK(names_in(folder / "").size() == 1);
    write_text(folder / "out/notes.txt", "mine");
    CHECK_THROWS_WITH(run(true, {0, 3}), Catch::Contains("notes.txt"));
    CHECK(read_text(folder / "out/notes.txt") == "mine");
    fs::create_directories(folder / "photos");
    write_text(folder / "photos/00000.png", "mine");
    CHECK_THROWS_AS(make_png_stack(small_display(), folder / "photos", true)->open(job, {0, 3}, false),
                    InputError);
    write_text(folder / "file", "mine");
    CHECK_THROWS_AS(make_png_stack(small_display(), folder / "file", true)->open(job, {0, 3}, false),
                    InputError);
    CHECK_THROWS_AS(make_png_stack(small_display(), folder / "file/out", true)->open(job, {0, 3}, false),
                    Error);
}

TEST_CASE("a full disk is a fault, and the layers before it stay", "[png_stack]") {
    const TemporaryFolder folder;
    const Job job = cone();
    PrinterProfile profile = small_display();
    signal(SIGXFSZ, SIG_IGN);
    rlimit old{};
    REQUIRE(getrlimit(RLIMIT_FSIZE, &old) == 0);
    auto backend = make_png_stack(profile, folder / "out", false);
    backend->open(job, {0, 12}, false);
    const Layer first(job, 0);
    backend->write(first, *backend->render(first));
    rlimit tiny = old;
    tiny.rlim_cur = 100;
    REQUIRE(setrlimit(RLIMIT_FSIZE, &tiny) == 0);
    const Layer second(job, 1);
    CHECK_THROWS_AS(backend->write(second, *backend->render(second)), FaultError);
    REQUIRE(setrlimit(RLIMIT_FSIZE, &old) == 0);
    signal(SIGXFSZ, SIG_DFL);
    backend.reset();
    CHECK(make_png_stack(profile, folder / "out", false)->open(job, {0, 12}, true) == 1);
}

TEST_CASE("supports are drawn dimmed, the part over them", "[png_stack]") {
    const auto antialiasing = GENERATE(Antialiasing::off, Antialiasing::rows, Antialiasing::exact);
    const double grey = GENERATE(1.0, 0.6, 0.0);
    CAPTURE(static_cast<int>(antialiasing), grey);
    const TemporaryFolder folder;
    PrinterProfile profile = small_display();
    profile.image.antialiasing = antialiasing;
    profile.support.grey = grey;
    const Job job = block_beside_support();
    run_layers(job, *make_png_stack(profile, folder / "out", false), {0, 4});
    // Each alone, as images that supports have no part in.
    Job alone = job;
    alone.supports = nullptr;
    run_layers(alone, *make_png_stack(profile, folder / "part", false), {0, 4});
    alone.part = job.supports;
    run_layers(alone, *make_png_stack(profile, folder / "supports", false), {0, 4});
    const DecodedImage image = decode_image(folder / "out/00002.png");
    const DecodedImage part = decode_image(folder / "part/00002.png");
    const DecodedImage supports = decode_image(folder / "supports/00002.png");
    bool shared = false;
    std::size_t wrong = 0;
    for (std::size_t k = 0; k < image.pixels.size(); ++k) {
        const auto dimmed = static_cast<int>(std::lround(supports.pixels[k] * grey));
        shared = shared || (part.pixels[k] > 0 && dimmed > 0);
        wrong += image.pixels[k] != std::max<int>(part.pixels[k], dimmed) ? 1 : 0;
    }
    CHECK(wrong == 0);
    // The border between them, at 0.03 mm, divides pixels of 0.1 mm.
    if (antialiasing != Antialiasing::off && grey > 0) CHECK(shared);
    const auto json = nlohmann::json::parse(read_text(folder / "out/job.json"));
    CHECK(json["support_grey"] == grey);
    CHECK(!nlohmann::json::parse(read_text(folder / "part/job.json")).contains("support_grey"));
    const auto backend = make_png_stack(profile, folder / "again", true);
    backend->open(job, {0, 4}, false);
    const auto product = backend->render(Layer(job, 1));
    const double tolerance = antialiasing == Antialiasing::off ? 0.02 : 0.002;
    CHECK(product->area == Approx(4.03 * 6).epsilon(tolerance));
    CHECK(product->support_area == Approx(3 * 2).epsilon(tolerance));
}

TEST_CASE("a scaffold shows in every image format and on portrait displays", "[png_stack]") {
    const TemporaryFolder folder;
    PrinterProfile profile = small_display();
    profile.image.portrait = GENERATE(false, true);
    profile.image.format = GENERATE(ImageFormat::png, ImageFormat::pgm);
    std::swap(profile.image.width, profile.image.height);
    if (!profile.image.portrait) std::swap(profile.image.width, profile.image.height);
    profile.support.grey = 0.5;
    const Job job = supported_table();
    run_layers(job, *make_png_stack(profile, folder / "out", false), {0, 20});
    for (const int i : {0, 5, 11, 14, 17}) {
        CAPTURE(i);
        const std::string ending = profile.image.format == ImageFormat::png ? "png" : "pgm";
        const DecodedImage image = decode_image(folder / fmt::format("out/{:05}.{}", i, ending));
        const bool part = job.plane(i) > 3;
        CHECK(image.filled() * 0.01 ==
              Approx(part ? table_area : 0.5 * scaffold_area(job.plane(i))).epsilon(0.01));
        CHECK(*std::ranges::max_element(image.pixels) == (part ? 255 : 128));
    }
}

TEST_CASE("a grey that is none is refused where there are supports", "[png_stack]") {
    const TemporaryFolder folder;
    PrinterProfile profile = small_display();
    profile.support.grey = GENERATE(-0.1, 1.1, std::nan(""));
    CHECK_THROWS_WITH(make_png_stack(profile, folder / "out", false)->open(supported_table(), {0, 20}, false),
                      Catch::Contains("grey of supports"));
    CHECK_NOTHROW(make_png_stack(profile, folder / "out", false)->open(cone(), {0, 12}, false));
}

}  // namespace png_stack_test
