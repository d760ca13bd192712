// Several pictures and sizes in one pattern: which is where, how large, and the same on any number of
// threads.
#include "procedural/pattern/pattern_example.h"

#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "procedural/pattern/flat_pattern.h"
#include "procedural/skin/raster.h"
#include "tests/app/commands/mentions.h"
#include "tests/procedural/texture/sheets.h"

namespace pattern_example_test {

using namespace sheets;

namespace {

Volume picture(const std::string& name) {
    return read_picture(std::string(LAMELLA_SOURCE_DIR "/examples/inputs/") + name);
}

/// A number to the left of a line x, mm, and another to the right.
class LeftRight : public Grading {
  public:
    LeftRight(double line, double left, double right) : line_(line), left_(left), right_(right) {}
    double at(dvec3 p) const override { return p.x < line_ ? left_ : right_; }
    Interval range(const Box&) const override { return {std::min(left_, right_), std::max(left_, right_)}; }

  private:
    double line_, left_, right_;
};

ExampleSettings changing(const GradingPtr& weight) {
    ExampleSettings settings;
    settings.size = 20;
    settings.reinforce = Reinforcement::none;
    settings.second = {std::make_shared<const Volume>(picture("bricks.png")), weight};
    return settings;
}

struct Strip {
    double share = 0;  ///< solid
    std::size_t gaps = 0;
};
/// Returns what a sheet has between two lines x, mm.
Strip strip_of(const FlatPattern& sheet, double lo, double hi) {
    constexpr double pixels = 8;
    const int first = static_cast<int>(lo * pixels), end = static_cast<int>(hi * pixels),
              height = static_cast<int>(sheet.size().y * pixels);
    TiledMask gap(end - first, height);
    for (int y = 0; y < height; ++y) {
        for (int x = first; x < end; ++x)
            gap.marked[gap.index(x - first, y)] = sheet.distance((dvec2(x, y) + 0.5) / pixels) > 0 ? 0 : 1;
    }
    return {1 - static_cast<double>(gap.count()) / static_cast<double>(gap.marked.size()),
            components_of(gap).size()};
}

}  // namespace

TEST_CASE("sites take their patches from the picture that they want", "[pattern]") {
    const Volume blobs = picture("blobs.png");
    for (const double weight : {0.0, 1.0}) {
        ExampleSettings settings = changing(make_constant_grading(weight));
        settings.size = 64;
        settings.strut = 4;  // sites 1 mm apart
        const Example example = make_example(blobs, settings);
        const std::vector<PatternLevel> levels = levels_of(96, example.levels);
        const auto exemplar = [&](const SurfaceSites& sites, int doublings) {
            return example.exemplar(sites, doublings, settings);
        };
        const Exemplar finest = exemplar(levels.back().sites, 0);
        REQUIRE(finest.parts.size() == 2);
        CHECK(example.share(finest) == Approx(mean_of(example.pictures[weight > 0 ? 1 : 0])));
        const auto first = static_cast<std::uint32_t>(finest.parts[1].first_row * finest.solid.width);
        const SynthesisResult found = synthesise_levels(levels, exemplar, {});
        const auto of_second =
            std::ranges::count_if(found.matches, [&](std::uint32_t match) { return match >= first; });
        CHECK(of_second == (weight > 0 ? std::ssize(found.matches) : 0));
    }
}

TEST_CASE("a pattern changes from one picture to another where it is asked to", "[pattern]") {
    const Volume blobs = picture("blobs.png");
    const ExampleSettings settings = changing(std::make_shared<LeftRight>(20, 0, 1));
    const FlatPattern sheet(blobs, {40, 24}, settings);
    const double of_blobs = mean_of(make_example(blobs, settings).pictures[0]),
                 of_bricks = mean_of(make_example(blobs, settings).pictures[1]);
    CHECK(sheet.wanted_share() == Approx(0.5 * (of_blobs + of_bricks)).margin(0.01));
    CHECK(strip_of(sheet, 3, 17).share == Approx(of_blobs).margin(0.05));
    CHECK(strip_of(sheet, 23, 37).share == Approx(of_bricks).margin(0.05));
}

TEST_CASE("parts of a pattern are as large as the picture is there", "[pattern]") {
    ExampleSettings settings;
    settings.size = 30;
    settings.least_size = 15;
    settings.strut = 0.6;
    settings.graded_size = std::make_shared<LeftRight>(30, 30, 15);
    settings.reinforce = Reinforcement::none;
    const FlatPattern sheet(picture("blobs.png"), {60, 30}, settings);
    const Strip large = strip_of(sheet, 3, 27), small = strip_of(sheet, 33, 57);
    CHECK(large.share == Approx(small.share).margin(0.06));
    // Half as large, four times as many, but for those that the edges of the strips cut.
    CHECK(2 * small.gaps > 5 * large.gaps);
    CHECK(small.gaps < 5 * large.gaps);
}

TEST_CASE("a pattern of several pictures and sizes is the same on any number of threads", "[pattern]") {
    ExampleSettings settings = changing(std::make_shared<LeftRight>(15, 0.2, 0.9));
    settings.least_size = 14;
    settings.graded_size = std::make_shared<LeftRight>(10, 20, 14);
    const Volume blobs = picture("blobs.png");
    const auto made = [&](int threads) {
        ThreadArena arena(threads);
        return arena.execute([&] { return FlatPattern(blobs, {30, 20}, settings); });
    };
    CHECK(made(1).pattern().printed.distance == made(4).pattern().printed.distance);
}

TEST_CASE("sizes too far apart, and a second picture without its weight, are refused", "[pattern]") {
    const Volume blobs = picture("blobs.png");
    const auto complaint = [&](const ExampleSettings& settings) {
        try {
            make_example(blobs, settings);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    ExampleSettings sizes;
    sizes.size = 60;
    sizes.least_size = 15;
    sizes.graded_size = std::make_shared<LeftRight>(0, 15, 60);
    CHECK(mentions(complaint(sizes), "15 to 60 mm wide; accepted: the largest at most 3.6 times"));
    sizes.least_size = 0;
    CHECK(mentions(complaint(sizes), "expected positive lengths"));
    CHECK(mentions(complaint(changing(nullptr)), "goes with its weight"));
    CHECK_THROWS_AS(stacked({make_exemplar(GreyImage(16, 16), 16)}, {1}), InputError);
    CHECK_THROWS_AS(
        stacked({make_exemplar(GreyImage(16, 16), 16), make_exemplar(GreyImage(16, 16), 16)}, {1, 0, 1}),
        InputError);
}

}  // namespace pattern_example_test
