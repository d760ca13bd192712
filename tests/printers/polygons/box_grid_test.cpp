// Boxes that meet a rectangle, against the obvious loop.
#include "printers/polygons/box_grid.h"

#include <random>
#include <set>

#include <catch2/catch.hpp>

namespace box_grid_test {

using namespace lamella;

TEST_CASE("a grid of boxes visits all that meet a rectangle", "[polygons]") {
    std::mt19937 random(4);
    const auto within = [&](double lo, double hi) { return std::uniform_real_distribution(lo, hi)(random); };
    const auto box = [&](double most) {
        const dvec2 lo(within(-50, 50), within(10, 40));
        return Rect{lo, lo + dvec2(within(0, most), within(0, most))};
    };
    std::vector<Rect> boxes;
    for (int i = 0; i < 300; ++i) boxes.push_back(box(i % 10 == 0 ? 30 : 2));
    const BoxGrid grid(boxes);
    for (int trial = 0; trial < 200; ++trial) {
        const Rect rect = box(20);
        std::set<std::size_t> visited;
        grid.visit(rect, [&](std::size_t number) { visited.insert(number); });
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            const Rect both = intersect(rect, boxes[i]);
            if (both.lo.x <= both.hi.x && both.lo.y <= both.hi.y) REQUIRE(visited.contains(i));
        }
        CHECK(visited.size() < boxes.size());
    }
}

TEST_CASE("a grid of no box, or of boxes at one point, is none to stumble over", "[polygons]") {
    BoxGrid(std::vector<Rect>()).visit({{-1, -1}, {1, 1}}, [](std::size_t) { FAIL("there is no box"); });
    int count = 0;
    BoxGrid(std::vector<Rect>(3, Rect{{2, 2}, {2, 2}})).visit({{0, 0}, {4, 4}}, [&](std::size_t) {
        ++count;
    });
    CHECK(count == 3);
}

}  // namespace box_grid_test
