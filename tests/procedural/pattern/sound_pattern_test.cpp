// Rounds of choosing bridges: which of them counts.
#include "procedural/pattern/sound_pattern.h"

#include <catch2/catch.hpp>

#include "procedural/pattern/pattern_example.h"
#include "tests/procedural/texture/sheets.h"

namespace sound_pattern_test {

using namespace sheets;

namespace {

constexpr int size = 64;

/// Chooses one strut a round, each farther up a sheet, and says how weak the patterns are.
class Scripted : public BridgeChoice {
  public:
    Scripted(const SurfaceSites& sites, std::vector<double> weaknesses)
        : sites_(sites), weaknesses_(std::move(weaknesses)) {}

    std::vector<SiteLine> choose(std::span<const float> distances) override {
        seen.emplace_back(distances.begin(), distances.end());
        if (seen.size() == weaknesses_.size()) return {};
        SiteLine line;
        for (std::uint32_t x = 8; x < 40; ++x) {
            const auto site = static_cast<std::uint32_t>(12 * seen.size() * size) + x;
            line.push_back({site, sites_.places[site]});
        }
        return {line};
    }
    double weakness() const override { return weaknesses_[seen.size() - 1]; }

    std::vector<std::vector<float>> seen;

  private:
    const SurfaceSites& sites_;
    std::vector<double> weaknesses_;
};

}  // namespace

TEST_CASE("the least weak of the patterns with bridges is kept, and of those alike the last", "[pattern]") {
    const std::vector<PatternLevel> levels = levels_of(size, 1);
    const GreyImage picture = example("blobs.png");
    const Exemplar exemplar = make_exemplar(picture, 40);
    const SynthesisResult found = synthesise_levels(levels, picture, 40, {});
    const PrintSettings print{.share = mean_of(exemplar.solid), .strut = 4, .limit = 4};
    struct Case {
        std::vector<double> weaknesses;
        std::size_t kept;
    };
    for (const Case& tried :
         {Case{{5, 2, 7, 4}, 1}, Case{{5, 4, 3}, 2}, Case{{1, 1, 1}, 2}, Case{{1, 2}, 0}}) {
        Scripted choice(levels.back().sites, tried.weaknesses);
        const SoundPattern made = sound_pattern(levels.back(), exemplar, found, {}, print, &choice);
        REQUIRE(choice.seen.size() == tried.weaknesses.size());
        CHECK(made.printed.distance == choice.seen[tried.kept]);
        CHECK(made.bridges == tried.kept);
        CHECK(choice.seen[0] != choice.seen[1]);
    }
}

}  // namespace sound_pattern_test
