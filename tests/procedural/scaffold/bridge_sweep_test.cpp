// The sweep finds what trying every bar finds.
#include "procedural/scaffold/bridge_sweep.h"

#include <catch2/catch.hpp>
#include <random>

namespace bridge_sweep_test {

using namespace lamella;

namespace {

std::vector<ScaffoldElement> random_elements(unsigned seed, int count) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> side(0, 25), height(8, 20), landing(0, 5);
    std::vector<ScaffoldElement> elements;
    for (int k = 0; k < count; ++k) {
        const bool end = k % 7 == 3;
        elements.push_back({{side(random), side(random), height(random)},
                            k % 3 == 0 ? landing(random) : 0.0,
                            end,
                            k % 11 != 5});
    }
    return elements;
}

/// The best score by the definition: every height that some element of the strip allows at most, every pair
/// of ends.
double best_score(const std::vector<ScaffoldElement>& elements, const ScaffoldShape& shape, std::size_t self,
                  dvec2 u) {
    const double pillar = (2 * shape.pillar - shape.wall) * shape.wall;
    const double middle = (shape.tip + shape.bar_width) / 2;
    const double bar_share = BridgeScore::share_of_bar * shape.bar_width * shape.bar_height / pillar;
    const double connector_share = 3.14159265358979323846 / 4 * middle * middle / pillar;
    const dvec2 n(-u.y, u.x);
    double best = -infinity;
    for (int level = 6; level < 200; ++level) {
        const double z = shape.bed + level * shape.layer_height;
        bool of_an_element = false;
        struct On {
            double along, length, landing;
            std::size_t number;
        };
        std::vector<On> strip;
        for (std::size_t k = 0; k < elements.size(); ++k) {
            const ScaffoldElement& e = elements[k];
            const dvec2 d = dvec2(e.touch) - dvec2(elements[self].touch);
            const double across = std::abs(glm::dot(d, n)), along = glm::dot(d, u), rise = e.touch.z - z;
            const double least = e.is_end ? 2 * shape.layer_height : shape.connector;
            if (!e.open || across > shape.reach || std::abs(along) > shape.bridge) continue;
            const double slack = rise - std::max(least, across / shape.lean);
            of_an_element = of_an_element || (slack >= -1e-7 && slack < shape.layer_height - 1e-7);
            if (slack < -1e-7 || rise > shape.longest_connector) continue;
            strip.push_back({along, std::sqrt(across * across + rise * rise), e.landing, k});
        }
        if (!of_an_element) continue;
        for (const On& first : strip) {
            for (const On& last : strip) {
                const double width = last.along - first.along;
                if (width < shape.pillar || width > shape.bridge) continue;
                double saved = 0, longest = 0;
                std::size_t held = 0;
                bool holds_self = false;
                for (const On& on : strip) {
                    if (on.along < first.along || on.along > last.along) continue;
                    saved += z - on.landing;
                    longest = std::max(longest, on.length);
                    ++held;
                    holds_self = holds_self || on.number == self;
                }
                const double legs = 2 * z - first.landing - last.landing;
                const double gain = saved - legs - bar_share * width;
                if (!holds_self || gain <= 0) continue;
                best = std::max(best, gain - connector_share * static_cast<double>(held) * longest);
            }
        }
    }
    return best;
}

}  // namespace

TEST_CASE("the sweep's bar is the best of all", "[bridge_sweep]") {
    const ScaffoldShape shape;
    for (unsigned seed = 1; seed <= 6; ++seed) {
        const auto elements = random_elements(seed, 60);
        BridgeSweep sweep(shape);
        for (const ScaffoldElement& element : elements) sweep.add(element);
        std::size_t found = 0;
        for (std::size_t e = 0; e < elements.size(); e += 4) {
            if (!elements[e].open) continue;
            for (int d = 0; d < BridgeSweep::directions; ++d) {
                const auto bar = sweep.best(e, d, {});
                const double score = best_score(elements, shape, e, BridgeSweep::along(d));
                REQUIRE(bar.has_value() == (score > -infinity));
                if (!bar) continue;
                ++found;
                CHECK(bar->score == Approx(score).epsilon(1e-9));
                CHECK(glm::distance(bar->a, bar->b) <= shape.bridge + 1e-9);
                CHECK(std::find(bar->held.begin(), bar->held.end(), e) != bar->held.end());
            }
        }
        CHECK(found > 20);
    }
}

TEST_CASE("a refused bar gives way to the next best", "[bridge_sweep]") {
    const auto elements = random_elements(9, 60);
    BridgeSweep sweep{ScaffoldShape{}};
    for (const ScaffoldElement& element : elements) sweep.add(element);
    std::size_t anchor = 0;
    while (!sweep.best(anchor, 2, {})) ++anchor;
    std::vector<std::array<std::int64_t, 3>> refused;
    double last = infinity;
    while (const auto bar = sweep.best(anchor, 2, refused)) {
        CHECK(bar->score <= last);
        CHECK(std::find(refused.begin(), refused.end(), bar->key) == refused.end());
        last = bar->score;
        refused.push_back(bar->key);
    }
    CHECK(refused.size() > 3);
}

TEST_CASE("bars lie along eight directions of a half circle", "[bridge_sweep]") {
    for (int d = 0; d < BridgeSweep::directions; ++d) {
        const dvec2 u = BridgeSweep::along(d);
        CHECK(glm::dot(u, u) == Approx(1));
        CHECK(std::atan2(u.y, u.x) == Approx(d * 3.14159265358979323846 / 8).margin(1e-12));
    }
}

}  // namespace bridge_sweep_test
