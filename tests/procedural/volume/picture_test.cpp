// Pictures with transparent parts: as they look on white paper, and as a skin's pattern.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "engine/io/image_file.h"
#include "procedural/volume/volume.h"
#include "tests/app/commands/command_run.h"
#include "tests/procedural/volume/scratch_folder.h"

namespace picture_test {

using namespace lamella;

namespace {

constexpr int side = 64;

/// A black cross on a ground that is transparent (2 channels: grey and alpha, 4: colours and alpha) or white
/// (1 or 3). Its edge pixels are half there.
void write_cross(const std::string& path, int channels) {
    std::vector<std::uint8_t> pixels;
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const int off = std::min(std::abs(x - side / 2), std::abs(y - side / 2));
            const int ink = off < 6 ? 255 : off == 6 ? 128 : 0;
            const bool transparent = channels % 2 == 0;
            for (int c = 0; c < channels; ++c) {
                const bool is_alpha = transparent && c == channels - 1;
                pixels.push_back(static_cast<std::uint8_t>(is_alpha ? ink : transparent ? 0 : 255 - ink));
            }
        }
    }
    ImageData image;
    image.width = image.height = side;
    image.channels = channels;
    image.pixels = pixels;
    write_image(path, image);
}

const std::vector<std::uint8_t>& bytes_of(const Volume& volume) {
    return std::get<std::vector<std::uint8_t>>(volume.samples);
}

}  // namespace

TEST_CASE("what is transparent in a picture is as bright as paper", "[picture]") {
    const ScratchFolder folder("picture");
    const auto path = [&](int channels) { return (folder / (std::to_string(channels) + ".png")).string(); };
    for (const int channels : {1, 2, 3, 4}) write_cross(path(channels), channels);
    const Volume white = read_picture(path(1));
    CHECK(bytes_of(white) == bytes_of(read_volume(path(1))));
    for (const int channels : {2, 3, 4}) {
        CAPTURE(channels);
        CHECK(bytes_of(read_picture(path(channels))) == bytes_of(white));
    }
    // A colour is as dark as it looks: blue on white as dark as black, nearly; yellow on white hardly.
    const auto painted = [&](std::uint8_t r, std::uint8_t g, std::uint8_t b) {
        ImageData image;
        std::vector<std::uint8_t> pixels;
        for (const std::uint8_t v : {r, g, b}) pixels.push_back(v);
        image.width = image.height = 1;
        image.channels = 3;
        image.pixels = pixels;
        write_image(path(5), image);
        return int{bytes_of(read_picture(path(5)))[0]};
    };
    CHECK(painted(255, 0, 0) == 54);
    CHECK(painted(0, 0, 255) == 18);
    CHECK(painted(255, 255, 0) == 237);
    CHECK(painted(77, 77, 77) == 77);
    // A volume keeps the numbers of its channel.
    CHECK(bytes_of(read_volume(path(4))) == std::vector<std::uint8_t>(side * side, 0));
    CHECK(bytes_of(read_volume(path(4), 3))[0] == 0);
}

TEST_CASE("a skin has the same windows of a transparent picture as of one on white", "[picture]") {
    const ScratchFolder folder("picture_skin");
    const auto section = [&](int channels) {
        const std::string path = (folder / (std::to_string(channels) + ".png")).string();
        write_cross(path, channels);
        const Outcome run = run_lamella(
            "section --shape box --shape-size 6,6,4 --skin 0.8 --skin-pattern image --skin-image " + path +
            " --skin-image-size 5 --skin-strut 0.5 --z 1.9 --format json");
        INFO(run.err);
        REQUIRE(run.code == 0);
        return nlohmann::json::parse(run.out);
    };
    const auto white = section(1);
    CHECK(section(4) == white);
}

}  // namespace picture_test
