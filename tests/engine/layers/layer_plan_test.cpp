// Plans of layers: every height against a plain sum, and equal layers to the bit as products.
#include "engine/layers/layer_plan.h"

#include <catch2/catch.hpp>
#include <random>

namespace layer_plan_test {

using namespace lamella;

TEST_CASE("equal layers are products of a number and a height, to the bit", "[layers]") {
    const LayerPlan plan(1000, 0.05);
    CHECK(plan.equal());
    for (int i = 0; i < 1000; ++i) {
        CHECK(plan.bottom(i) == i * 0.05);
        CHECK(plan.middle(i) == (i + 0.5) * 0.05);
        CHECK(plan.top(i) == (i + 1) * 0.05);
    }
    CHECK(plan.height(3, 10) == 7 * 0.05);
    CHECK(plan == LayerPlan({{400, 0.05}, {0, 3}, {600, 0.05}}));
}

TEST_CASE("layers of several heights lie on each other", "[layers]") {
    std::mt19937_64 random(3);
    for (int round = 0; round < 50; ++round) {
        std::vector<double> heights;
        std::vector<EqualLayers> runs;
        for (int i = 0; i < 20; ++i) {
            const int count = std::uniform_int_distribution(0, 3)(random);
            const double height = 0.05 * std::uniform_int_distribution(1, 6)(random);
            runs.push_back({count, height});
            heights.insert(heights.end(), static_cast<std::size_t>(count), height);
        }
        const LayerPlan plan(runs);
        REQUIRE(plan.count() == static_cast<int>(heights.size()));
        double z = 0, least = 100, most = 0;
        for (int i = 0; i < plan.count(); ++i) {
            const double height = heights[static_cast<std::size_t>(i)];
            CHECK(plan.height(i) == height);
            CHECK(plan.bottom(i) == Approx(z).margin(1e-12));
            CHECK(plan.middle(i) == Approx(z + height / 2));
            CHECK(plan.top(i) == Approx(z + height));
            CHECK(plan.layer_at(z + height * 0.01) == i);
            CHECK(plan.layer_at(z + height * 0.99) == i);
            CHECK(plan.height(0, i) == Approx(z).margin(1e-12));
            z += height;
            least = std::min(least, height);
            most = std::max(most, height);
        }
        CHECK(plan.total() == Approx(z));
        CHECK(plan.least_height() == least);
        CHECK(plan.greatest_height() == most);
        CHECK(plan.layer_at(-1) == 0);
        CHECK(plan.layer_at(z + 1) == plan.count() - 1);
        const int half = plan.count() / 2;
        const LayerPlan lower = plan.lowest(half);
        CHECK(lower.count() == half);
        CHECK(lower.total() == Approx(plan.bottom(half)).margin(1e-12));
        CHECK(plan.begins_like(lower));
        CHECK(plan.begins_like(plan));
        CHECK(!lower.begins_like(plan));
        CHECK(plan.divided(2).total() == Approx(z / 2));
        const LayerPlan raised = plan.raised(lower);
        CHECK(raised.count() == half + plan.count());
        CHECK(raised.top(raised.count() - 1) == Approx(z + lower.total()));
        CHECK(raised.begins_like(lower));
    }
}

TEST_CASE("the heights of a plan in words", "[layers]") {
    CHECK(LayerPlan(3, 0.05).heights_text() == "0.05 mm");
    CHECK(LayerPlan({{1, 0.3}, {2, 0.1}}).heights_text() == "0.1 to 0.3 mm");
}

}  // namespace layer_plan_test
