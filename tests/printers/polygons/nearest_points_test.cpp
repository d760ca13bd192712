// The tree finds what looking at all points finds.
#include "printers/polygons/nearest_points.h"

#include <catch2/catch.hpp>
#include <random>

namespace nearest_points_test {

using namespace lamella;

TEST_CASE("tours equal those of brute force", "[nearest_points]") {
    const unsigned seed = GENERATE(range(1U, 13U));
    INFO("seed " << seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> coordinate(-50, 50);
    std::uniform_int_distribution<int> coarse(-3, 3);
    std::vector<dvec2> points;
    for (unsigned i = 0; i < seed * 60; ++i) {
        // Every third set lies on a coarse lattice, with many coincident points.
        points.push_back(seed % 3 == 0 ? dvec2(coarse(random), coarse(random))
                                       : dvec2(coordinate(random), coordinate(random)));
    }
    NearestPoints tree(points);
    std::vector<bool> used(points.size(), false);
    dvec2 at{coordinate(random), coordinate(random)};
    for (std::size_t n = 0; n < points.size(); ++n) {
        REQUIRE(!tree.empty());
        const auto distance = [&](std::size_t i) { return glm::distance(at, points[i]); };
        double least = infinity;
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (!used[i]) least = std::min(least, distance(i));
        }
        const std::size_t found = tree.nearest(at);
        REQUIRE(!used[found]);
        REQUIRE(distance(found) == least);
        used[found] = true;
        tree.remove(found);
        tree.remove(found);
        at = points[found];
    }
    CHECK(tree.empty());
    CHECK(NearestPoints({}).empty());
}

}  // namespace nearest_points_test
