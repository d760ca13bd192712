// The traced axis of rings whose axis is known, and of random ones with holes: it is whole, and as far from
// the border as it says.
#include "printers/polygons/bisector_trace.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <catch2/catch.hpp>

namespace bisector_trace_test {

using namespace lamella;

namespace {

using Rings = std::vector<std::vector<dvec2>>;

double distance_to_border(const Rings& rings, dvec2 p) {
    double least = 1e9;
    for (const auto& ring : rings) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const dvec2 a = ring[i], way = ring[(i + 1) % ring.size()] - a;
            const double t = std::clamp(glm::dot(p - a, way) / glm::dot(way, way), 0.0, 1.0);
            least = std::min(least, glm::distance(p, a + way * t));
        }
    }
    return least;
}

double area_of(const Rings& rings) {
    double area = 0;
    for (const auto& ring : rings) {
        for (std::size_t i = 0; i < ring.size(); ++i) area += cross(ring[i], ring[(i + 1) % ring.size()]) / 2;
    }
    return area;
}

/// The area that the discs' contacts and centres enclose, edge by edge: that of the whole piece.
double area_of(const MedialAxis& axis) {
    double area = 0;
    for (const MedialEdge& edge : axis.edges) {
        const std::array<dvec2, 6> share = {edge.right[0], edge.right[1], axis.nodes[edge.node[1]].at,
                                            edge.left[1],  edge.left[0],  axis.nodes[edge.node[0]].at};
        for (std::size_t i = 0; i < 6; ++i) area += cross(share[i], share[(i + 1) % 6]) / 2;
    }
    return area;
}

double greatest_radius(const MedialAxis& axis) {
    return std::ranges::max_element(axis.nodes, {}, &MedialNode::radius)->radius;
}

/// A ring around a point whose corners lie between two distances, on whole steps; clockwise for a hole.
std::vector<dvec2> random_ring(std::mt19937& random, dvec2 centre, double least, double most, int corners,
                               bool hole) {
    std::vector<dvec2> ring;
    for (int i = 0; i < corners; ++i) {
        const double angle = (hole ? -2 : 2) * pi * i / corners;
        const double radius = std::uniform_real_distribution(least, most)(random);
        ring.push_back(glm::round(centre + radius * dvec2(std::cos(angle), std::sin(angle))));
    }
    return ring;
}

void check_axis(const Rings& rings) {
    constexpr double tolerance = 10;
    const auto axis = trace_medial_axis(rings, tolerance);
    REQUIRE(axis);
    for (const MedialNode& node : axis->nodes)
        REQUIRE(node.radius == Approx(distance_to_border(rings, node.at)).margin(0.1));
    CHECK(area_of(*axis) == Approx(area_of(rings)).epsilon(0.005));
}

}  // namespace

TEST_CASE("the axis of a rectangle is its ridge and the bisectors of its corners", "[medial_axis]") {
    const auto axis = trace_medial_axis(Rings{{{0, 0}, {6000, 0}, {6000, 1000}, {0, 1000}}}, 5);
    REQUIRE(axis);
    CHECK(axis->edges.size() == 5);
    CHECK(greatest_radius(*axis) == Approx(500));
    check_axis(Rings{{{0, 0}, {6000, 0}, {6000, 1000}, {0, 1000}}});
}

TEST_CASE("regular rings, whose bisectors meet in one point, are traced", "[medial_axis]") {
    for (const int corners : {3, 4, 5, 6, 8, 12}) {
        std::vector<dvec2> ring;
        for (int i = 0; i < corners; ++i) {
            const double angle = 2 * pi * i / corners;
            ring.push_back(5000.0 * dvec2(std::cos(angle), std::sin(angle)));
        }
        CAPTURE(corners);
        const auto axis = trace_medial_axis(Rings{ring}, 5);
        REQUIRE(axis);
        CHECK(greatest_radius(*axis) == Approx(5000 * std::cos(pi / corners)));
        CHECK(area_of(*axis) == Approx(area_of(Rings{ring})));
    }
}

TEST_CASE("points on the straight way between their neighbours change nothing", "[medial_axis]") {
    const auto plain = trace_medial_axis(Rings{{{0, 0}, {4000, 0}, {0, 3000}}}, 5);
    const auto divided =
        trace_medial_axis(Rings{{{0, 0}, {1000, 0}, {2000, 0}, {4000, 0}, {0, 3000}, {0, 1500}}}, 5);
    REQUIRE(plain);
    REQUIRE(divided);
    CHECK(plain->edges.size() == divided->edges.size());
    CHECK(greatest_radius(*plain) == Approx(1000));
    CHECK(greatest_radius(*divided) == Approx(1000));
}

TEST_CASE("rings that turn right and left are traced, with holes and without", "[medial_axis]") {
    std::mt19937 random(11);
    for (int trial = 0; trial < 60; ++trial) {
        CAPTURE(trial);
        const int corners = 5 + static_cast<int>(random() % 60);
        Rings rings{random_ring(random, {3000, -2000}, 4000, 8000, corners, false)};
        for (const dvec2 centre : {dvec2(1500, -2000), dvec2(4500, -2000), dvec2(3000, -3500)}) {
            if (random() % 2 == 0)
                rings.push_back(
                    random_ring(random, centre, 200, 700, 3 + static_cast<int>(random() % 9), true));
        }
        // A star of few corners may cut its inner parts off.
        if (corners >= 8 || rings.size() == 1) check_axis(rings);
    }
}

TEST_CASE("a plate of many holes is traced, with a cycle around each", "[medial_axis]") {
    std::mt19937 random(3);
    Rings rings{{{0, 0}, {40000, 0}, {40000, 30000}, {0, 30000}}};
    for (int y = 0; y < 14; ++y) {
        for (int x = 0; x < 19; ++x)
            rings.push_back(random_ring(random, {2000.0 * x + 2000, 2000.0 * y + 2000}, 300, 900, 8, true));
    }
    check_axis(rings);
    const auto axis = trace_medial_axis(rings, 10);
    std::vector<int> degree(axis->nodes.size());
    for (const MedialEdge& edge : axis->edges) {
        for (const std::uint32_t node : edge.node) ++degree[node];
    }
    CHECK(axis->edges.size() - axis->nodes.size() + 1 == rings.size() - 1);
    CHECK(std::ranges::count(degree, 0) == 0);
}

TEST_CASE("rings that cross themselves have no axis", "[medial_axis]") {
    CHECK(!trace_medial_axis(Rings{{{0, 0}, {4000, 4000}, {4000, 0}, {0, 3000}}}, 5));
    CHECK(!trace_medial_axis(Rings{{{0, 0}, {0, 0}, {1000, 0}}}, 5));
    CHECK(!trace_medial_axis(Rings{}, 5));
    CHECK(!trace_medial_axis(Rings{{}}, 5));
}

}  // namespace bisector_trace_test
