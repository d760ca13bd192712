// Synthesis on sheets: matches against an exhaustive search, threads, fixed sites, and likeness by a measure
// that it does not optimise.
#include "procedural/texture/texture_synthesis.h"

#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "tests/procedural/texture/sheets.h"

namespace texture_synthesis_test {

using namespace sheets;

namespace {

SynthesisResult on_threads(int threads, const std::vector<PatternLevel>& levels, const GreyImage& picture,
                           int width) {
    ThreadArena arena(threads);
    return arena.execute([&] { return synthesise_levels(levels, picture, width, {}); });
}

/// Returns the least difference of the window of a site to any window of the exemplar, a pixel.
double least_difference(const SiteWindows& windows, const Exemplar& exemplar, const SitePattern& pattern,
                        std::size_t site) {
    const int radius = windows.radius();
    double least = 1e9;
    for (int y = radius; y < exemplar.solid.height - radius; ++y) {
        for (int x = radius; x < exemplar.solid.width - radius; ++x) {
            double sum = 0;
            for (int up = -radius; up <= radius; ++up) {
                for (int across = -radius; across <= radius; ++across) {
                    const std::size_t other = windows.of(site)[windows.place(across, up)];
                    const std::size_t pixel = exemplar.solid.index(x + across, y + up);
                    const double solid = pattern.solid[other] - exemplar.solid.values[pixel],
                                 distance = pattern.distance[other] - exemplar.distance.values[pixel];
                    sum += solid * solid + distance * distance;
                }
            }
            least = std::min(least, sum);
        }
    }
    return least / static_cast<double>(windows.area());
}

}  // namespace

TEST_CASE("an exemplar's distances are those of its border, at every scale", "[texture]") {
    // A disc of radius 30 in 128 x 128 pixels.
    GreyImage disc(128, 128);
    const auto from_middle = [](double x, double y) { return std::hypot(x - 64, y - 64); };
    for (int y = 0; y < 128; ++y) {
        for (int x = 0; x < 128; ++x)
            disc.values[disc.index(x, y)] = from_middle(x + 0.5, y + 0.5) < 30 ? 1 : 0;
    }
    for (const int width : {128, 64, 32}) {
        const Exemplar exemplar = make_exemplar(disc, width);
        const double pixels = 128.0 / width;
        CHECK(mean_of(exemplar.solid) == Approx(mean_of(disc)).epsilon(1e-12));
        for (int y = 0; y < width; ++y) {
            for (int x = 0; x < width; ++x) {
                const double inside = (30 - from_middle((x + 0.5) * pixels, (y + 0.5) * pixels)) / pixels;
                const double exact = 0.5 + 0.5 * std::clamp(inside / Exemplar::reach, -1.0, 1.0);
                CHECK(exemplar.distance.values[exemplar.distance.index(x, y)] == Approx(exact).margin(0.12));
            }
        }
    }
    CHECK_THROWS_AS(make_exemplar(disc, 129), InputError);
}

TEST_CASE("a sheet is the same on any number of threads, and another one for another seed", "[texture]") {
    const std::vector<PatternLevel> levels = levels_of(64, 2);
    const GreyImage picture = example("blobs.png");
    const SynthesisResult one = on_threads(1, levels, picture, 64), four = on_threads(4, levels, picture, 64);
    CHECK(one.pattern.solid == four.pattern.solid);
    CHECK(one.pattern.distance == four.pattern.distance);
    CHECK(one.matches == four.matches);
    SynthesisSettings other;
    other.seed = 2;
    CHECK(synthesise_levels(levels, picture, 64, other).matches != one.matches);
}

TEST_CASE("matches are nearly those of an exhaustive search", "[texture]") {
    const std::vector<PatternLevel> levels = levels_of(64, 2);
    const GreyImage picture = example("blobs.png");
    SynthesisSettings settings;
    settings.spread = 0;
    const Exemplar exemplar = make_exemplar(picture, 64);
    const SiteWindows& windows = levels.back().windows;
    const SynthesisResult found = synthesise_levels(levels, picture, 64, settings);
    // Energies are those of the pattern before the last vote, which makes it more like its matches.
    double exhaustive = 0;
    int count = 0;
    for (std::size_t site = 0; site < found.matches.size(); site += 37, ++count)
        exhaustive += least_difference(windows, exemplar, found.pattern, site);
    CHECK(exhaustive / count < found.energy);
    CHECK(exhaustive / count > 0.5 * found.energy);
}

TEST_CASE("fixed sites stay, and the pattern goes on from them as in the exemplar", "[texture]") {
    constexpr int size = 48, from = 20, to = 32;
    const SurfaceSites sites = flat_sites(size, size, 1);
    const SiteWindows windows = site_windows(sites, 9);
    const Exemplar exemplar = make_exemplar(example("blobs.png"), 80);
    SitePattern start{std::vector<float>(sites.size(), 0.5F), std::vector<float>(sites.size(), 0.5F)};
    std::vector<std::uint8_t> fixed(sites.size(), 0);
    for (int y = 0; y < size; ++y) {
        for (int x = from; x < to; ++x) {
            const auto at = static_cast<std::size_t>(y * size + x);
            fixed[at] = 1;
            start.solid[at] = static_cast<float>(exemplar.solid.values[exemplar.solid.index(x, y)]);
            start.distance[at] = static_cast<float>(exemplar.distance.values[exemplar.distance.index(x, y)]);
        }
    }
    const SynthesisResult found = synthesise(windows, exemplar, start, fixed, 0, {});
    double beside = 0, elsewhere = 0;
    for (int y = 6; y < size - 6; ++y) {
        for (int x = 0; x < size; ++x) {
            const auto at = static_cast<std::size_t>(y * size + x);
            if (fixed[at] != 0) REQUIRE(found.pattern.solid[at] == start.solid[at]);
            const double difference =
                std::abs(found.pattern.solid[at] - exemplar.solid.values[exemplar.solid.index(x, y)]);
            if (x == from - 1 || x == to) beside += difference / 2;
            if (x == 4) elsewhere += difference;
        }
    }
    CHECK(beside < 0.3 * elsewhere);
}

TEST_CASE("a pattern looks like its exemplar as another part of the same picture does", "[texture]") {
    // The left half is the exemplar, the right half the other crop.
    struct Case {
        const char* file;
        bool invert;
    };
    for (const Case& tried : {Case{"blobs.png", false}, Case{"net.png", true}}) {
        const GreyImage whole = box_filtered(example(tried.file, tried.invert), 160);
        const GreyImage picture = black_and_white(whole), left = columns(picture, 0, 80),
                        right = columns(picture, 80, 160);
        const std::vector<PatternLevel> levels = levels_of(112, 2);
        const SynthesisResult found = synthesise_levels(levels, left, 80, {});
        const float threshold = threshold_for_share(found.pattern, mean_of(left));
        const GreyImage pattern = cut(found.pattern, threshold);
        CHECK(mean_of(pattern) == Approx(mean_of(left)).margin(0.02));
        for (const int patch : {7, 13}) {
            CAPTURE(tried.file, patch);
            const int stride = 5;
            // Each patch of the pattern is somewhere in the exemplar, and each of the exemplar in the
            // pattern.
            CHECK(patch_distance(pattern, left, patch, stride) <
                  1.25 * patch_distance(right, left, patch, stride));
            CHECK(patch_distance(left, pattern, patch, stride) <
                  1.25 * patch_distance(left, right, patch, stride));
        }
    }
}

TEST_CASE("a sheet has no seam where it tiles, and no large part of it is there twice", "[texture]") {
    constexpr int width = 80, size = 112, patch = 13;
    struct Case {
        const char* file;
        bool invert;
    };
    for (const Case& tried : {Case{"blobs.png", false}, Case{"net.png", true}}) {
        CAPTURE(tried.file);
        const GreyImage picture = black_and_white(box_filtered(example(tried.file, tried.invert), width));
        const std::vector<PatternLevel> levels = levels_of(size, 2);
        double at_border = 0, elsewhere = 0;
        constexpr int seeds = 4;
        for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
            SynthesisSettings settings;
            settings.seed = seed;
            const SynthesisResult found = synthesise_levels(levels, picture, width, settings);
            const GreyImage sheet = cut(found.pattern, threshold_for_share(found.pattern, mean_of(picture)));
            // Patches over the border, and those as far from it as can be.
            at_border +=
                patch_distance(shifted(sheet, 0, -patch / 2, size, patch), picture, patch, 4) / seeds;
            elsewhere += patch_distance(shifted(sheet, 0, size / 2, size, patch), picture, patch, 4) / seeds;
            constexpr int part = 36;  // a fifth of the example's area
            if (seed == 1) CHECK(least_self_difference(sheet, part, 8) > 0.05);
        }
        CHECK(at_border < 1.1 * elsewhere);
    }
}

TEST_CASE("a synthesis that makes no sense is refused, and one that is cancelled stops", "[texture]") {
    const SurfaceSites sites = flat_sites(32, 32, 1);
    const SiteWindows windows = site_windows(sites, 9);
    const GreyImage picture = example("blobs.png");
    CHECK_THROWS_AS(synthesise(windows, make_exemplar(picture, 8), {}, {}, 0, {}), InputError);
    CHECK_THROWS_AS(synthesise(windows, make_exemplar(picture, 40), {{0.5F}, {0.5F}}, {}, 0, {}), InputError);
    CancelToken cancel;
    cancel.cancel();
    SynthesisSettings settings;
    settings.cancel = &cancel;
    CHECK_THROWS_AS(synthesise(windows, make_exemplar(picture, 40), {}, {}, 0, settings), Interrupted);
}

}  // namespace texture_synthesis_test
