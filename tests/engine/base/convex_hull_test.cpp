// Hulls of points with known outlines, and distances from them.
#include "engine/base/convex_hull.h"

#include <catch2/catch.hpp>

namespace convex_hull_test {

using namespace lamella;

TEST_CASE("a hull has the outer corners alone", "[orientation]") {
    const std::vector<dvec2> hull =
        convex_hull({{0, 0}, {4, 0}, {2, 0}, {4, 3}, {1, 1}, {0, 3}, {0, 3}, {2, 3}});
    CHECK(hull == std::vector<dvec2>{{0, 0}, {4, 0}, {4, 3}, {0, 3}});
    CHECK(convex_hull({{1, 1}, {1, 1}}).size() == 1);
    CHECK(convex_hull({{0, 0}, {2, 2}, {1, 1}}).size() == 2);
}

TEST_CASE("depth in a hull is the distance from its edges", "[orientation]") {
    const std::vector<dvec2> square = convex_hull({{0, 0}, {4, 0}, {4, 4}, {0, 4}});
    CHECK(depth_in_hull(square, {1, 2}) == Approx(1));
    CHECK(depth_in_hull(square, {2, -3}) == Approx(-3));
    CHECK(depth_in_hull(square, {7, 8}) == Approx(-5));
    CHECK(depth_in_hull({{0, 0}, {4, 0}}, {2, 1}) == Approx(-1));
    CHECK(depth_in_hull({{1, 1}}, {4, 5}) == Approx(-5));
    CHECK(depth_in_hull({}, {0, 0}) == -infinity);
}

}  // namespace convex_hull_test
