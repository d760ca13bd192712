// Shortest ways inside polygons against a dense visibility graph, and what they may never do.
#include "printers/polygons/shortest_way.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "tests/printers/polygons/hand_made_contours.h"

namespace shortest_way_test {

using namespace lamella;
using namespace lamella::test;

namespace {

using Point = PolygonSight::Point;

dvec2 mm(Point p) { return dvec2(static_cast<double>(p.X), static_cast<double>(p.Y)) / polygon_scale; }
Point units(dvec2 p) { return to_polygon({p}).front(); }

struct Edge {
    dvec2 a, b;
};

std::vector<Edge> edges_of(const Polygons& polygons) {
    std::vector<Edge> edges;
    for (const auto& ring : polygons) {
        for (std::size_t i = 0; i < ring.size(); ++i)
            edges.push_back({mm(ring[i]), mm(ring[(i + 1) % ring.size()])});
    }
    return edges;
}

bool inside_of(const std::vector<Edge>& edges, dvec2 p) {
    bool in = false;
    for (const auto& [a, b] : edges) {
        if ((a.y <= p.y) != (b.y <= p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)) in = !in;
    }
    return in;
}

double distance_to(const std::vector<Edge>& edges, dvec2 p) {
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [a, b] : edges) {
        const double t = std::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
        least = std::min(least, glm::distance(p, a + (b - a) * t));
    }
    return least;
}

/// Whether all of the line lies inside, or as near to that as coordinates are rounded: between any two places
/// where it meets an edge or passes by a corner it is looked at in the middle.
bool clear(const std::vector<Edge>& edges, dvec2 p, dvec2 q) {
    constexpr double rounding = 1e-5;  // mm
    std::vector<double> cuts{0, 1};
    for (const auto& [a, b] : edges) {
        const double t = glm::dot(a - p, q - p) / glm::dot(q - p, q - p);
        if (t > 0 && t < 1 && glm::distance(p + (q - p) * t, a) < rounding) cuts.push_back(t);
        const double slope = cross(q - p, b - a);
        if (std::abs(slope) < 1e-12) continue;
        const double at = cross(a - p, b - a) / slope, on = cross(a - p, q - p) / slope;
        if (at > 0 && at < 1 && on >= 0 && on <= 1) cuts.push_back(at);
    }
    std::ranges::sort(cuts);
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
        const dvec2 middle = p + (q - p) * ((cuts[i] + cuts[i + 1]) / 2);
        if (!inside_of(edges, middle) && distance_to(edges, middle) > rounding) return false;
    }
    return true;
}

/// Length of the shortest way among all corners, each of which sees what it sees; infinite if there is none.
double brute_force(const Polygons& polygons, dvec2 from, dvec2 to) {
    const auto edges = edges_of(polygons);
    std::vector<dvec2> nodes{from, to};
    for (const Edge& edge : edges) nodes.push_back(edge.a);
    std::vector<double> lengths(nodes.size(), std::numeric_limits<double>::infinity());
    std::vector<bool> done(nodes.size());
    lengths[0] = 0;
    for (std::size_t round = 0; round < nodes.size(); ++round) {
        std::size_t at = nodes.size();
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            if (!done[i] && (at == nodes.size() || lengths[i] < lengths[at])) at = i;
        }
        if (std::isinf(lengths[at])) break;
        done[at] = true;
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            const double there = lengths[at] + glm::distance(nodes[at], nodes[i]);
            if (!done[i] && there < lengths[i] && clear(edges, nodes[at], nodes[i])) lengths[i] = there;
        }
    }
    return lengths[1];
}

double length_of(dvec2 from, const std::vector<Point>& corners, dvec2 to) {
    double length = 0;
    for (const Point corner : corners) {
        length += glm::distance(from, mm(corner));
        from = mm(corner);
    }
    return length + glm::distance(from, to);
}

/// Boxes and ragged stars, some cut out of others; coordinates on a coarse grid make corners line up.
Polygons random_polygons(std::mt19937& random, bool on_grid) {
    const auto number = [&](double lo, double hi) {
        const double v = std::uniform_real_distribution<>(lo, hi)(random);
        return on_grid ? std::round(v) : v;
    };
    const auto star = [&](dvec2 center, double size) {
        std::vector<dvec2> points;
        for (int i = 0; i < 9; ++i) {
            const double angle = 2 * 3.14159265358979 * i / 9, r = number(size / 4, size);
            points.push_back(center + r * dvec2(std::cos(angle), std::sin(angle)));
        }
        return to_polygon(points);
    };
    Polygons solid, holes;
    for (int i = 0; i < 3; ++i) {
        const dvec2 lo{number(0, 12), number(0, 12)};
        solid.push_back(to_polygon(box_contour(lo, lo + dvec2(number(2, 8), number(2, 8))).points));
        if (!on_grid) solid.push_back(star({number(4, 16), number(4, 16)}, 8));
    }
    for (int i = 0; i < 5; ++i) {
        const dvec2 lo{number(2, 16), number(2, 16)};
        holes.push_back(to_polygon(box_contour(lo, lo + dvec2(number(1, 3), number(1, 3))).points));
        if (!on_grid) holes.push_back(star({number(4, 16), number(4, 16)}, 2));
    }
    // Shrunk, so that what hangs together by a corner alone does so no longer.
    return offset_polygons(subtract_polygons(unite_polygons(solid, {}), unite_polygons(holes, {})), -0.01);
}

/// Whether parts of the border all but touch: what leads through there is anybody's guess.
bool is_pinched(const std::vector<Edge>& edges) {
    for (const Edge& edge : edges) {
        std::vector<Edge> others;
        std::ranges::copy_if(edges, std::back_inserter(others),
                             [&](const Edge& e) { return e.a != edge.a && e.b != edge.a; });
        if (others.size() + 2 != edges.size() || distance_to(others, edge.a) < 1e-3) return true;
    }
    return false;
}

}  // namespace

TEST_CASE("no way is shorter, and none leaves the polygons", "[shortest_way]") {
    std::mt19937 random(1);
    int looked_at = 0, bent = 0, apart = 0;
    for (int round = 0; round < 120; ++round) {
        const bool on_grid = round % 3 == 0;
        const Polygons polygons = random_polygons(random, on_grid);
        const PolygonSight sight(polygons);
        const auto edges = edges_of(polygons);
        if (is_pinched(edges)) continue;
        ++looked_at;
        std::vector<Point> places;
        while (places.size() < 6) {
            const Point p = units({std::uniform_real_distribution<>(0, 20)(random),
                                   std::uniform_real_distribution<>(0, 20)(random)});
            if (distance_to(edges, mm(p)) < 1e-4) continue;
            CHECK(sight.contains(p) == inside_of(edges, mm(p)));
            if (sight.contains(p)) places.push_back(p);
        }
        places.push_back(polygons.front()[1]);  // a corner
        for (std::size_t i = 0; i + 1 < places.size(); ++i) {
            const Point from = places[i], to = places[i + 1];
            CAPTURE(round, i, mm(from).x, mm(from).y, mm(to).x, mm(to).y);
            const auto way = shortest_way(sight, from, to);
            const double best = brute_force(polygons, mm(from), mm(to));
            REQUIRE(way.has_value() == std::isfinite(best));
            if (!way) {
                ++apart;
                continue;
            }
            CHECK(length_of(mm(from), *way, mm(to)) == Approx(best).margin(1e-4));
            bent += !way->empty();
            dvec2 at = mm(from);
            for (const Point corner : *way) CHECK(clear(edges, std::exchange(at, mm(corner)), mm(corner)));
            CHECK(clear(edges, at, mm(to)));
            const auto back = shortest_way(sight, to, from);
            REQUIRE(back.has_value());
            CHECK(length_of(mm(to), *back, mm(from)) == Approx(best).margin(1e-4));
        }
    }
    CHECK(looked_at > 90);
    CHECK(bent > 200);
    CHECK(apart > 20);
}

TEST_CASE("the way round a disc is two tangents and an arc", "[shortest_way]") {
    constexpr double radius = 3, pi = 3.14159265358979;
    const PolygonSight sight({to_polygon(box_contour({-10, -10}, {10, 10}).points),
                              to_polygon(as_hole(disc_contour({0, 0}, radius, 400), 0).points)});
    const dvec2 from{-8, 0}, to{8, 0};
    const auto way = shortest_way(sight, units(from), units(to));
    REQUIRE(way.has_value());
    const double tangent = std::sqrt(64 - radius * radius), arc = radius * (pi - 2 * std::acos(radius / 8));
    const double shortest = 2 * tangent + arc;
    CHECK(length_of(from, *way, to) == Approx(shortest).epsilon(1e-5));
    // Not found where it may not be so long.
    CHECK(shortest_way(sight, units(from), units(to), shortest * 1.001 * polygon_scale) == way);
    CHECK_FALSE(shortest_way(sight, units(from), units(to), shortest * 0.999 * polygon_scale).has_value());
}

TEST_CASE("a search that takes too long gives up", "[shortest_way]") {
    const PolygonSight sight({to_polygon(box_contour({-10, -10}, {10, 10}).points),
                              to_polygon(as_hole(disc_contour({0, 0}, 3, 400), 0).points)});
    const Point from = units({-8, 0}), to = units({8, 0});
    CHECK(shortest_way(sight, from, to).has_value());
    CHECK_FALSE(shortest_way(sight, from, to, infinity, 100).has_value());
    CHECK(shortest_way(sight, from, units({-8, 5}), infinity, 100)->empty());
}

TEST_CASE("points a little outside are let in, others are not", "[shortest_way]") {
    const PolygonSight sight({to_polygon(box_contour({0, 0}, {10, 10}).points),
                              to_polygon(as_hole(box_contour({4, 4}, {6, 6}), 0).points)});
    const double reach = 0.2 * polygon_scale;
    for (const dvec2 p : {dvec2(-0.1, 5), dvec2(10.1, 10.1), dvec2(5, 4.1), dvec2(5.9, 5.9), dvec2(0, 5)}) {
        const auto in = sight.enter(units(p), reach);
        REQUIRE(in.has_value());
        CHECK(sight.contains(*in));
        CHECK(glm::distance(mm(*in), p) < 0.15);
    }
    CHECK(*sight.enter(units({3, 3}), reach) == units({3, 3}));
    CHECK_FALSE(sight.enter(units({-0.3, 5}), reach).has_value());
    CHECK_FALSE(sight.enter(units({5, 5}), reach).has_value());
    CHECK_FALSE(PolygonSight({}).enter(units({5, 5}), reach).has_value());
}

}  // namespace shortest_way_test
