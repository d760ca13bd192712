// Support points and what they hold, against all of them looked at one by one.
#include "engine/surveys/support_placer.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

#include "engine/solids/primitives.h"

namespace support_placer_test {

using namespace lamella;

TEST_CASE("a place is held by a point within the spacing that is not above it") {
    constexpr double spacing = 3;
    SupportPlacer placer(spacing, nullptr);
    std::mt19937 random(9);
    std::uniform_real_distribution<double> place(-20, 20);
    std::vector<dvec3> points;
    for (int k = 0; k < 150; ++k) {
        points.emplace_back(place(random), place(random), place(random));
        REQUIRE(placer.place(points.back(), SupportReason::overhang));
    }
    int held = 0;
    for (int k = 0; k < 5000; ++k) {
        const dvec3 p(place(random), place(random), place(random));
        const bool below = std::any_of(points.begin(), points.end(),
                                       [&](dvec3 q) { return q.z <= p.z && glm::length(q - p) <= spacing; });
        REQUIRE(placer.held(p) == below);
        held += below ? 1 : 0;
    }
    REQUIRE(held > 100);
    REQUIRE(placer.points().size() == points.size());
    REQUIRE(placer.left_out() == 0);
}

TEST_CASE("a blocked point is counted, and holds what is blocked alone") {
    SupportPlacer placer(3, make_box({{0, -10, -10}, {10, 10, 10}}));
    REQUIRE_FALSE(placer.place({0.5, 0, 0}, SupportReason::span));
    REQUIRE(placer.left_out() == 1);
    REQUIRE(placer.points().empty());
    REQUIRE(placer.held({1.5, 0, 0}));
    REQUIRE_FALSE(placer.held({-0.5, 0, 0}));
    REQUIRE(placer.place({-0.5, 0, 0}, SupportReason::island));
    REQUIRE(placer.held({-1, 0, 0}));
    REQUIRE(placer.points() == std::vector<SupportPoint>{{{-0.5, 0, 0}, SupportReason::island}});
}

}  // namespace support_placer_test
