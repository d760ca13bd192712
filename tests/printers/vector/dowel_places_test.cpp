// Pins stand where there is room, and keep layers from being turned over.
#include "printers/vector/dowel_places.h"

#include <algorithm>
#include <catch2/catch.hpp>

namespace dowel_places_test {

using namespace lamella;

namespace {

Polygons square(double half) {
    return {to_polygon({{-half, -half}, {half, -half}, {half, half}, {-half, half}})};
}

/// The least, over turning over about either middle line and half a turn, of how far the worst hole is off.
double misfit(const std::vector<dvec2>& pins) {
    double least = infinity;
    for (const dvec2 sign : {dvec2(-1, 1), dvec2(1, -1), dvec2(-1, -1)}) {
        double worst = 0;
        for (const dvec2& p : pins) {
            double nearest = infinity;
            for (const dvec2& q : pins) nearest = std::min(nearest, glm::length(p * sign - q));
            worst = std::max(worst, nearest);
        }
        least = std::min(least, worst);
    }
    return least;
}

}  // namespace

TEST_CASE("two pins are far apart and betray a layer that is turned over", "[dowels]") {
    const auto pins = dowel_places(square(30), {0, 0}, 2, 3);
    REQUIRE(pins.size() == 2);
    for (const dvec2& p : pins) CHECK(is_inside(square(30), p));
    CHECK(glm::length(pins[0] - pins[1]) > 70);  // of a diagonal of 85 mm
    CHECK(misfit(pins) >= 3);
}

TEST_CASE("three pins fit one way only", "[dowels]") {
    const auto pins = dowel_places(square(30), {0, 0}, 3, 3);
    REQUIRE(pins.size() == 3);
    std::vector<double> sides;
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(is_inside(square(30), pins[i]));
        sides.push_back(glm::length(pins[i] - pins[(i + 1) % 3]));
    }
    std::sort(sides.begin(), sides.end());
    CHECK(sides[0] >= 9);
    CHECK(sides[1] - sides[0] >= 3);
    CHECK(sides[2] - sides[1] >= 3);
    CHECK(misfit(pins) >= 3);
}

TEST_CASE("pins avoid holes and are refused where there is no room", "[dowels]") {
    Polygons ring = square(30);
    ring.push_back(to_polygon({{-28, -28}, {-28, 28}, {28, 28}, {28, -28}}));
    CHECK(!is_inside(ring, {0, 0}));
    CHECK(is_inside(ring, {29, 0}));
    CHECK(!is_inside(ring, {31, 0}));
    const auto pins = dowel_places(ring, {0, 0}, 2, 3);
    REQUIRE(pins.size() == 2);
    for (const dvec2& p : pins) CHECK(is_inside(ring, p));
    CHECK(dowel_places(square(2), {0, 0}, 2, 3).empty());
    CHECK(dowel_places({}, {0, 0}, 2, 3).empty());
    // A thread of a region is found by its border.
    const Polygons thin{to_polygon({{0, 0}, {0.01, 0}, {40.01, 25}, {40, 25}})};
    CHECK(dowel_places(thin, {20, 30}, 2, 3).size() == 2);
}

}  // namespace dowel_places_test
