// Planes averaged over a layer's height, gamma and limits of grey, and the margin of a display.
#include <catch2/catch.hpp>
#include <numeric>

#include "engine/base/error.h"
#include "engine/solids/primitives.h"
#include "printers/masks/mask.h"
#include "tests/printers/common/plane_solids.h"

namespace mask_tone_test {

using namespace lamella;
using namespace lamella::test;

namespace {

/// A ramp that rises by 1 in 10 along x over a flat bottom, as planes see it.
Job ramp() {
    return make_job(
        {{0, 0, 0}, {10, 2, 1}},
        [](double z) {
            return std::vector<Figure>{rectangle({0, 0}, {10 - 10 * z, 2})};
        },
        0.5);
}

PrinterProfile display() {
    PrinterProfile profile;
    profile.image.width = 100;
    profile.image.height = 20;
    profile.image.pixel_x = profile.image.pixel_y = 0.1;
    return profile;
}

/// Grey values of the middle row, and the layer's area.
struct MiddleRow {
    std::vector<int> greys;
    double area = 0;
};
MiddleRow middle_row(const Job& job, int layer, const PrinterProfile& profile) {
    MiddleRow middle;
    const MaskLayout layout(profile.image, job.bounds);
    std::vector<int> pixels;
    middle.area = mask_layer(Layer(job, layer), layout, profile.image, 1,
                             [&](std::span<const GreyRun> runs, int /*rows*/) {
                                 for (const GreyRun& run : runs)
                                     pixels.insert(pixels.end(), run.length, int{run.value});
                             })
                      .part;
    const auto width = static_cast<std::size_t>(layout.width());
    REQUIRE(pixels.size() == width * static_cast<std::size_t>(layout.height()));
    const auto first = pixels.begin() + static_cast<std::ptrdiff_t>(width) * (layout.height() / 2);
    middle.greys.assign(first, first + static_cast<std::ptrdiff_t>(width));
    return middle;
}

}  // namespace

TEST_CASE("several planes a layer make a ramp's edge grey over z", "[mask]") {
    PrinterProfile profile = display();
    const MiddleRow one = middle_row(ramp(), 0, profile);
    profile.image.sub_layers = 50;
    const MiddleRow fifty = middle_row(ramp(), 0, profile);
    // The layer is solid up to x = 5 mm and empty from 10 mm on; in between the share of its height that is
    // solid falls evenly.
    for (std::size_t column = 0; column < 100; ++column) {
        const double x = (static_cast<double>(column) + 0.5) * 0.1;
        const double share = std::clamp(2 - x / 5, 0.0, 1.0);
        CHECK(fifty.greys[column] == Approx(255 * share).margin(255.0 / 50));
        CHECK(one.greys[column] == (x < 7.5 ? 255 : 0));
    }
    CHECK(one.area == Approx(15));
    CHECK(fifty.area == Approx(15));
}

TEST_CASE("a box is the same however many planes are averaged", "[mask]") {
    const Job box = make_job(
        {{0, 0, 0}, {7.03, 1.51, 1}},
        [](double) {
            return std::vector<Figure>{rectangle({0, 0}, {7.03, 1.51})};
        },
        0.5);
    PrinterProfile profile = display();
    for (const Antialiasing antialiasing : {Antialiasing::rows, Antialiasing::exact}) {
        profile.image.antialiasing = antialiasing;
        profile.image.sub_layers = 1;
        const MiddleRow one = middle_row(box, 1, profile);
        profile.image.sub_layers = 3;
        CHECK(middle_row(box, 1, profile).greys == one.greys);
    }
}

TEST_CASE("grey follows gamma between its limits", "[mask]") {
    PrinterProfile profile = display();
    profile.image.sub_layers = 50;
    const MiddleRow plain = middle_row(ramp(), 0, profile);
    profile.image.gamma = 2.2;
    profile.image.min_grey = 0.2;
    profile.image.full_grey = 0.9;
    const MiddleRow toned = middle_row(ramp(), 0, profile);
    CHECK(toned.area == plain.area);
    for (std::size_t column = 0; column < 100; ++column) {
        const double coverage = plain.greys[column] / 255.0;
        const double expected = plain.greys[column] == 0 ? 0 : 255 * (0.2 + 0.7 * std::pow(coverage, 2.2));
        CHECK(toned.greys[column] == Approx(expected).margin(0.5000001));
    }
}

TEST_CASE("supports are dimmed after the display's own grey", "[mask]") {
    Job job = ramp();
    job.supports = job.part;
    job.part = make_job(
                   {{0, 0, 0}, {10, 2, 1}},
                   [](double) {
                       return std::vector<Figure>{rectangle({0, 0}, {1, 2})};
                   },
                   0.5)
                   .part;
    PrinterProfile profile = display();
    profile.image.full_grey = 0.8;
    std::vector<int> pixels;
    const MaskLayout layout(profile.image, job.bounds);
    mask_layer(Layer(job, 0), layout, profile.image, 0.5, [&](std::span<const GreyRun> runs, int) {
        for (const GreyRun& run : runs) pixels.insert(pixels.end(), run.length, int{run.value});
    });
    CHECK(pixels[5] == 204);
    CHECK(pixels[50] == 102);
    CHECK(pixels[90] == 0);
}

TEST_CASE("a display's margin keeps parts away from its edge", "[mask]") {
    PrinterProfile profile = display();
    const Job job = ramp();
    CHECK_NOTHROW(MaskLayout(profile.image, job.bounds));
    profile.image.margin = 0.1;
    CHECK_THROWS_WITH(
        MaskLayout(profile.image, job.bounds),
        Catch::Contains("has room for 9.800 x 1.800 mm") && Catch::Contains("0.1 mm kept clear"));
    profile.image.width = 102;
    profile.image.height = 22;
    CHECK_NOTHROW(MaskLayout(profile.image, job.bounds));
}

TEST_CASE("greys that make no sense are refused", "[mask]") {
    const auto refused = [](const auto& change) {
        PrinterProfile profile = display();
        change(profile.image);
        CHECK_THROWS_AS(MaskLayout(profile.image, ramp().bounds), InputError);
    };
    for (const double wrong : {-0.1, 1.1, std::nan("")}) {
        refused([&](ImageProfile& image) { image.min_grey = wrong; });
        refused([&](ImageProfile& image) { image.full_grey = wrong; });
    }
    refused([](ImageProfile& image) { image.min_grey = 0.6, image.full_grey = 0.5; });
    for (const double wrong : {0.0, -1.0, 11.0, std::nan("")})
        refused([&](ImageProfile& image) { image.gamma = wrong; });
    for (const int wrong : {0, -1, 65}) refused([&](ImageProfile& image) { image.sub_layers = wrong; });
    refused([](ImageProfile& image) { image.margin = -1; });
    refused([](ImageProfile& image) { image.sub_layers = 2, image.antialiasing = Antialiasing::off; });
}

}  // namespace mask_tone_test
