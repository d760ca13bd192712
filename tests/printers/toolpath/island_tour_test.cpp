// Tours of islands against the best of all orders, and where beads begin and end.
#include "printers/toolpath/island_tour.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <numeric>
#include <random>

namespace island_tour_test {

using namespace lamella;

namespace {

const TravelCost cost{2};

Bead loop_around(dvec2 center, double half) {
    Bead bead;
    for (const dvec2 corner : {dvec2(-1, -1), dvec2(0, -1), dvec2(1, -1), dvec2(1, 0), dvec2(1, 1),
                               dvec2(0, 1), dvec2(-1, 1), dvec2(-1, 0)})
        bead.points.push_back(center + half * corner);
    bead.closed = true;
    return bead;
}

Bead line(dvec2 from, dvec2 to) {
    Bead bead;
    bead.points = {from, (from + to) * 0.5, to};
    bead.widths = {1, 2, 3};
    return bead;
}

double distance(dvec2 a, dvec2 b) { return glm::length(a - b); }

double between(const std::vector<Bead>& a, const std::vector<Bead>& b) {
    double least = 1e9;
    for (const dvec2 p : a.front().points) {
        for (const dvec2 q : b.front().points) least = std::min(least, distance(p, q));
    }
    return least;
}

}  // namespace

TEST_CASE("a tour of few islands costs nearly as little as the best", "[bead_order]") {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> anywhere(0, 9);
    double found = 0, best_of_all = 0;
    for (int trial = 0; trial < 40; ++trial) {
        std::vector<std::vector<Bead>> islands;
        islands.reserve(7);
        for (int i = 0; i < 7; ++i)
            islands.push_back({loop_around({anywhere(random), anywhere(random)}, 0.4)});
        std::vector<IslandStop> stops;
        stops.reserve(islands.size());
        for (const auto& island : islands) stops.emplace_back(island);
        const auto cost_of = [&](const std::vector<std::size_t>& order) {
            double least = 1e9;
            for (const dvec2 p : islands[order[0]].front().points) least = std::min(least, glm::length(p));
            double sum = cost(least);
            for (std::size_t i = 1; i < order.size(); ++i)
                sum += cost(between(islands[order[i - 1]], islands[order[i]]));
            return sum;
        };
        const std::vector<std::size_t> tour = island_tour(stops, {0, 0}, cost);
        std::vector<std::size_t> order(islands.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        REQUIRE(std::ranges::is_permutation(tour, order));
        double best = 1e9;
        do {
            best = std::min(best, cost_of(order));
        } while (std::ranges::next_permutation(order).found);
        REQUIRE(cost_of(tour) >= best - 1e-9);
        found += cost_of(tour);
        best_of_all += best;
    }
    CHECK(found < 1.1 * best_of_all);
}

TEST_CASE("a third of the retractions between islands is spared", "[bead_order]") {
    std::mt19937 random(6);
    std::uniform_real_distribution<double> shift(-0.8, 0.8);
    constexpr int side = 20;
    std::vector<std::vector<Bead>> islands;
    std::vector<IslandStop> stops;
    std::vector<dvec2> entries;
    for (int i = 0; i < side * side; ++i) {
        islands.push_back(
            {loop_around(3.0 * dvec2(i % side, i / side) + dvec2(shift(random), shift(random)), 0.5)});
        stops.emplace_back(islands.back());
        entries.push_back(islands.back().front().points.front());
    }
    const auto retractions = [](const std::vector<Bead>& beads) {
        int count = 0;
        for (std::size_t i = 1; i < beads.size(); ++i)
            count += distance(end_of(beads[i - 1]), beads[i].points.front()) > cost.retract_from ? 1 : 0;
        return count;
    };
    dvec2 at{-1, -1};
    std::vector<Bead> nearest;
    for (const std::size_t next : short_tour(entries, at)) {
        std::vector<Bead> beads = islands[next];
        append_nearest(beads, Seam::nearest, at, nearest);
    }
    at = {-1, -1};
    const std::vector<std::size_t> tour = island_tour(stops, at, cost);
    std::vector<Bead> out;
    for (std::size_t i = 0; i < tour.size(); ++i) {
        const IslandStop* next = i + 1 < tour.size() ? &stops[tour[i + 1]] : nullptr;
        append_island(islands[tour[i]], Seam::nearest, next, cost, at, out);
        CHECK(at == out.back().points.front());
    }
    CHECK(out.size() == nearest.size());
    CHECK(retractions(out) < 0.7 * retractions(nearest));
}

TEST_CASE("the last bead of an island ends near the next one", "[bead_order]") {
    const std::vector<Bead> after{loop_around({20, 0}, 0.5)};
    const IslandStop next(after);
    std::vector<Bead> beads{line({8, 0}, {2, 0}), line({1, 3}, {1, 1}), loop_around({4, -3}, 1)};
    dvec2 at{0, 0};
    std::vector<Bead> out;
    append_island(beads, Seam::nearest, &next, cost, at, out);
    REQUIRE(out.size() == 3);
    CHECK(out[0].closed);  // walls hold the rest
    CHECK(out[1].points.front().x == 1);
    CHECK(out[2].points.front() == dvec2(2, 0));
    CHECK(out[2].widths == std::vector<double>{3, 2, 1});
    CHECK(at == dvec2(8, 0));
    // Without an island to follow, the nearest bead comes first.
    beads = {line({8, 0}, {2, 0}), line({1, 3}, {1, 1})};
    at = {9, 0};
    out.clear();
    append_island(beads, Seam::nearest, nullptr, cost, at, out);
    CHECK(out[0].points.front() == dvec2(8, 0));
    CHECK(at == dvec2(1, 3));
    // A seam that is asked for stays.
    beads = {loop_around({0, 0}, 1)};
    out.clear();
    append_island(beads, Seam::rear, &next, cost, at, out);
    CHECK(out[0].points.front().y == 1);
}

}  // namespace island_tour_test
