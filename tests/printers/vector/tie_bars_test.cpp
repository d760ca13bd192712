// Bars join all pieces, and as short as can be.
#include "printers/vector/tie_bars.h"

#include <catch2/catch.hpp>
#include <random>

#include "tests/printers/vector/cut_raster.h"

namespace tie_bars_test {

using namespace lamella;
using namespace lamella::test;

namespace {

ClipperLib::Path disc(dvec2 center, double radius, bool hole = false) {
    std::vector<dvec2> points;
    for (int i = 0; i < 96; ++i) {
        const double angle = 2 * pi * (hole ? -i : i) / 96;
        points.push_back(center + dvec2(std::cos(angle), std::sin(angle)) * radius);
    }
    return to_polygon(points);
}

std::vector<Ring> rings_of(const Polygons& polygons) {
    std::vector<Ring> rings;
    for (const auto& polygon : polygons) rings.push_back(to_points(polygon));
    return rings;
}

}  // namespace

TEST_CASE("a single piece needs no bar", "[ties]") {
    CHECK(tie_bars({}, 1).empty());
    CHECK(tie_bars({{disc({0, 0}, 5)}}, 1).empty());
}

TEST_CASE("two squares are joined by one bar across the gap", "[ties]") {
    const Polygons a{to_polygon({{0, 0}, {10, 0}, {10, 10}, {0, 10}})};
    const Polygons b{to_polygon({{14, 2}, {20, 2}, {20, 8}, {14, 8}})};
    const Polygons bars = tie_bars({a, b}, 2);
    REQUIRE(bars.size() == 1);
    CHECK(area_of(bars) == Approx(2 * (4 + 2 * 0.5)));  // the gap and a quarter of the width at either end
    const Polygons both{a[0], b[0]};
    CHECK(area_of(unite_polygons(both, bars)) == Approx(100 + 36 + 2 * 4));
}

TEST_CASE("an island in a hole is tied to the rim of the hole", "[ties]") {
    const Polygons ring{disc({0, 0}, 20), disc({0, 0}, 10, true)};
    const Polygons island{disc({3, 0}, 5)};
    const Polygons bars = tie_bars({ring, island}, 1);
    REQUIRE(bars.size() == 1);
    const Rect box = [&] {
        Rect r;
        for (const dvec2& p : to_points(bars[0])) r = unite(r, Rect{p, p});
        return r;
    }();
    CHECK(box.lo.x == Approx(8 - 0.25).margin(0.05));
    CHECK(box.hi.x == Approx(10 + 0.25).margin(0.05));
}

TEST_CASE("scattered pieces become one, by the tree of least length", "[ties]") {
    const unsigned seed = GENERATE(1U, 2U, 3U);
    CAPTURE(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(0, 60), radius(0.8, 3);
    std::vector<std::pair<dvec2, double>> discs;
    while (discs.size() < 24) {
        const dvec2 center(place(random), place(random));
        const double r = radius(random);
        const bool clear = std::all_of(discs.begin(), discs.end(), [&](const auto& other) {
            const dvec2 way = center - other.first;
            return std::sqrt(way.x * way.x + way.y * way.y) > r + other.second + 0.5;
        });
        if (clear) discs.emplace_back(center, r);
    }
    std::vector<Polygons> pieces;
    Polygons all;
    for (const auto& [center, r] : discs) {
        pieces.push_back({disc(center, r)});
        all.push_back(pieces.back()[0]);
    }
    const double width = 1;
    const Polygons bars = tie_bars(pieces, width);
    REQUIRE(bars.size() == discs.size() - 1);
    CHECK(count_raster_pieces(rings_of(all), 0.1) == 24);
    CHECK(count_raster_pieces(rings_of(unite_polygons(all, bars)), 0.1) == 1);
    // Prim's tree over the closed-form gaps between the discs.
    std::vector<double> gap(discs.size(), infinity);
    std::vector<bool> joined(discs.size(), false);
    double least = 0;
    std::size_t at = 0;
    for (std::size_t n = 1; n < discs.size(); ++n) {
        joined[at] = true;
        std::size_t next = 0;
        double nearest = infinity;
        for (std::size_t i = 0; i < discs.size(); ++i) {
            if (joined[i]) continue;
            const dvec2 way = discs[i].first - discs[at].first;
            gap[i] = std::min(gap[i],
                              std::sqrt(way.x * way.x + way.y * way.y) - discs[i].second - discs[at].second);
            if (gap[i] < nearest) {
                nearest = gap[i];
                next = i;
            }
        }
        least += nearest;
        at = next;
    }
    const double length = area_of(bars) / width - static_cast<double>(bars.size()) * width / 2;
    CHECK(length == Approx(least).epsilon(0.02));
}

}  // namespace tie_bars_test
