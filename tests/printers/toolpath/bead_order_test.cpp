// Tours against brute force and against nearest neighbours; where loops begin.
#include "printers/toolpath/bead_order.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <numeric>
#include <random>

namespace bead_order_test {

using namespace lamella;

namespace {

double length_of(std::span<const dvec2> points, const std::vector<std::size_t>& tour, dvec2 start) {
    double sum = 0;
    for (const std::size_t i : tour) {
        sum += glm::distance(start, points[i]);
        start = points[i];
    }
    return sum;
}

std::vector<dvec2> random_points(std::size_t count, std::mt19937& random) {
    std::uniform_real_distribution<double> place(0, 100);
    std::vector<dvec2> points(count);
    for (dvec2& p : points) p = {place(random), place(random)};
    return points;
}

std::vector<std::size_t> nearest_tour(std::span<const dvec2> points, dvec2 at) {
    std::vector<std::size_t> left(points.size()), tour;
    std::iota(left.begin(), left.end(), std::size_t{0});
    while (!left.empty()) {
        const auto next =
            std::ranges::min_element(left, {}, [&](std::size_t i) { return glm::distance(points[i], at); });
        at = points[*next];
        tour.push_back(*next);
        left.erase(next);
    }
    return tour;
}

Bead square() {
    Bead bead;
    bead.points = {{0, 0}, {4, 0}, {4, 4}, {2, 3}, {0, 4}};
    bead.widths = {1, 2, 3, 4, 5};
    bead.closed = true;
    return bead;
}

}  // namespace

TEST_CASE("a tour visits every point once, and few points nearly on the shortest way", "[bead_order]") {
    std::mt19937 random(3);
    double found = 0, shortest = 0;
    for (int trial = 0; trial < 40; ++trial) {
        const std::vector<dvec2> points = random_points(7, random);
        const std::vector<std::size_t> tour = short_tour(points, {0, 0});
        std::vector<std::size_t> order(points.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        REQUIRE(std::ranges::is_permutation(tour, order));
        double best = 1e9;
        do {
            best = std::min(best, length_of(points, order, {0, 0}));
        } while (std::ranges::next_permutation(order).found);
        REQUIRE(length_of(points, tour, {0, 0}) >= best - 1e-9);
        found += length_of(points, tour, {0, 0});
        shortest += best;
    }
    CHECK(found < 1.05 * shortest);
}

TEST_CASE("a tour of many points is shorter than going to the nearest", "[bead_order]") {
    std::mt19937 random(4);
    for (const std::size_t count : {50U, 400U, 3000U}) {
        CAPTURE(count);
        double found = 0, by_nearest = 0;
        for (std::size_t trial = 0; trial < 3000 / count; ++trial) {
            const std::vector<dvec2> points = random_points(count, random);
            const std::vector<std::size_t> tour = short_tour(points, {0, 0});
            std::vector<std::size_t> sorted = tour;
            std::ranges::sort(sorted);
            for (std::size_t i = 0; i < count; ++i) REQUIRE(sorted[i] == i);
            found += length_of(points, tour, {0, 0});
            by_nearest += length_of(points, nearest_tour(points, {0, 0}), {0, 0});
        }
        // Of many points the way by nearest neighbour is a quarter longer than the shortest, 2-opt's a
        // twentieth; of few, whose borders count, the difference is less.
        CHECK(found < 0.92 * by_nearest);
    }
    CHECK(short_tour({}, {0, 0}).empty());
    const std::vector<dvec2> same(20, dvec2(1, 1));
    CHECK(short_tour(same, {0, 0}).size() == 20);
}

TEST_CASE("loops begin where the seam is to be, with their widths", "[bead_order]") {
    const auto first = [](Seam seam, dvec2 from) {
        std::vector<Bead> beads{square()}, out;
        append_nearest(beads, seam, from, out);
        REQUIRE(out.size() == 1);
        CHECK(from == out[0].points.front());  // it ends there, too
        return std::pair(out[0].points.front(), out[0].widths.front());
    };
    CHECK(first(Seam::nearest, {5, 5}) == std::pair(dvec2(4, 4), 3.0));
    CHECK(first(Seam::nearest, {2, 2.5}) == std::pair(dvec2(2, 3), 4.0));
    CHECK(first(Seam::rear, {5, -5}).first.y == 4);
    // The sharpest corners are those beside the dent.
    CHECK(first(Seam::corner, {5, -5}).first.y == 4);
}

}  // namespace bead_order_test
