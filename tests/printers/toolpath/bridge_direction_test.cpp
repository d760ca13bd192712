// Bridges run from hold to hold, the short way.
#include "printers/toolpath/bridge_direction.h"

#include <catch2/catch.hpp>

#include "tests/printers/polygons/hand_made_contours.h"

namespace bridge_direction_test {

using namespace lamella;
using namespace lamella::test;

namespace {

constexpr double degree = 3.14159265358979 / 180;

Polygons box(dvec2 lo, dvec2 hi, double turn) {
    Contour contour = box_contour(lo, hi);
    const dvec2 x(std::cos(turn), std::sin(turn)), y(-x.y, x.x);
    for (dvec2& p : contour.points) p = x * p.x + y * p.y;
    return {to_polygon(contour.points)};
}

/// Angle between two directions without sense, degrees.
double between(dvec2 direction, double turn) {
    return std::acos(std::min(1.0, std::abs(direction.x * std::cos(turn) + direction.y * std::sin(turn)))) /
           degree;
}

}  // namespace

TEST_CASE("a bridge leads over the gap, however it is turned", "[bridge]") {
    for (double turn = 0; turn < 180; turn += 7.3) {
        CAPTURE(turn);
        const double a = turn * degree;
        // Held all round: the short way. Held at the far ends alone: the long way.
        const Polygons gap = box({-5, -15}, {5, 15}, a);
        const Polygons plate = box({-20, -30}, {20, 30}, a);
        CHECK(between(bridge_direction(gap, LayerBelow(subtract_polygons(plate, gap), 0.1), 0.45), a) < 5);
        const Polygons banks = unite_polygons(box({-5, 15}, {5, 30}, a), box({-5, -30}, {5, -15}, a));
        CHECK(between(bridge_direction(gap, LayerBelow(banks, 0.1), 0.45), a + 90 * degree) < 5);
        // A balcony: out from what holds it.
        const Polygons balcony = box({0, -15}, {4, 15}, a);
        CHECK(between(bridge_direction(balcony, LayerBelow(box({-20, -30}, {0, 30}, a), 0.1), 0.45), a) < 5);
    }
}

TEST_CASE("a bridge with no hold at all has a direction", "[bridge]") {
    const dvec2 along = bridge_direction(box({0, 0}, {20, 5}, 0), LayerBelow({}, 0.1), 0.45);
    CHECK(glm::length(along) == Approx(1));
}

}  // namespace bridge_direction_test
