// The axis against closed forms and against distances to the border by brute force; thin parts of known
// shapes.
#include "printers/polygons/medial_axis.h"

#include <catch2/catch.hpp>
#include <random>

#include "printers/toolpath/thin_parts.h"

namespace medial_axis_test {

using namespace lamella;

namespace {

double distance_to_border(const Polygons& piece, dvec2 p) {
    double least = 1e9;
    for (const ClipperLib::Path& ring : piece) {
        const std::vector<dvec2> points = to_points(ring);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const dvec2 a = points[i], way = points[(i + 1) % points.size()] - a;
            const double t = std::clamp(glm::dot(p - a, way) / glm::dot(way, way), 0.0, 1.0);
            least = std::min(least, glm::distance(p, a + way * t));
        }
    }
    return least;
}

bool is_inside(const Polygons& piece, dvec2 p) {
    const ClipperLib::IntPoint point(static_cast<ClipperLib::cInt>(p.x * polygon_scale),
                                     static_cast<ClipperLib::cInt>(p.y * polygon_scale));
    int windings = 0;
    for (const ClipperLib::Path& ring : piece) {
        if (ClipperLib::PointInPolygon(point, ring) != 0) windings += ClipperLib::Orientation(ring) ? 1 : -1;
    }
    return windings == 1;
}

/// A star of random radii round the origin, of which a smaller one may be a hole.
Polygons random_star(std::mt19937& random, bool with_hole) {
    std::uniform_real_distribution<double> share(0.5, 1.5);
    const auto ring = [&](double radius, int corners, int turn) {
        std::vector<dvec2> points;
        for (int i = 0; i < corners; ++i) {
            const double angle = turn * 2 * pi * i / corners, r = radius * share(random);
            points.push_back({50 + r * std::cos(angle), -70 + r * std::sin(angle)});
        }
        return to_polygon(points);
    };
    Polygons star{ring(3, 5 + static_cast<int>(random() % 20), 1)};
    if (with_hole) star.push_back(ring(0.7, 3 + static_cast<int>(random() % 8), -1));
    return star;
}

Polygons box(double x, double y) { return {to_polygon({{0, 0}, {x, 0}, {x, y}, {0, y}})}; }

ThinParts thin_parts(const Polygons& piece, double thickest) {
    return find_thin_parts(medial_axis(piece, 0.005), 0.1, thickest, 0.01);
}

}  // namespace

TEST_CASE("nodes of the axis lie inside, as far from the border as they say and from both contacts",
          "[medial_axis]") {
    std::mt19937 random(23);
    for (int trial = 0; trial < 60; ++trial) {
        const Polygons piece = random_star(random, trial % 2 == 1);
        const MedialAxis axis = medial_axis(piece, 0.01);
        REQUIRE(!axis.edges.empty());
        for (const MedialNode& node : axis.nodes) {
            REQUIRE(node.radius == Approx(distance_to_border(piece, node.at)).margin(0.003));
            REQUIRE((node.radius < 0.005 || is_inside(piece, node.at)));
        }
        double area = 0;
        for (const MedialEdge& edge : axis.edges) {
            const std::array<dvec2, 6> share = {edge.right[0], edge.right[1], axis.nodes[edge.node[1]].at,
                                                edge.left[1],  edge.left[0],  axis.nodes[edge.node[0]].at};
            for (std::size_t i = 0; i < 6; ++i)
                area += (share[i].x * share[(i + 1) % 6].y - share[i].y * share[(i + 1) % 6].x) / 2;
        }
        // The shares of all edges are the whole piece.
        REQUIRE(area == Approx(area_of(piece)).epsilon(0.002));
    }
}

TEST_CASE("the axis of a ring is its middle", "[medial_axis]") {
    std::vector<dvec2> outer, inner;
    for (int i = 0; i < 60; ++i) {
        const double angle = 2 * pi * i / 60;
        outer.push_back({5 * std::cos(angle), 5 * std::sin(angle)});
        inner.push_back({4.5 * std::cos(-angle), 4.5 * std::sin(-angle)});
    }
    const ThinParts parts = thin_parts({to_polygon(outer), to_polygon(inner)}, 0.6);
    REQUIRE(parts.lines.size() == 1);
    CHECK(parts.lines[0].closed);
    CHECK(parts.whole);
    for (const dvec2& p : parts.lines[0].points) CHECK(glm::length(p) == Approx(4.75).margin(0.02));
    for (const double thickness : parts.lines[0].thickness) CHECK(thickness == Approx(0.5).margin(0.02));
}

TEST_CASE("borders that cross themselves give an axis of sorts or none, but no harm", "[medial_axis]") {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(-2, 2);
    for (int trial = 0; trial < 200; ++trial) {
        std::vector<dvec2> points;
        points.reserve(12);
        for (int i = 0; i < 12; ++i) points.push_back({place(random), place(random)});
        const MedialAxis axis = medial_axis({to_polygon(points)}, 0.01);
        const ThinParts parts = find_thin_parts(axis, 0.1, 0.6, 0.01);
        for (const TaperedLine& line : parts.lines) {
            REQUIRE(line.points.size() == line.thickness.size());
            REQUIRE(line.points.size() >= 2);
            for (const dvec2& p : line.points) REQUIRE((std::isfinite(p.x) && std::isfinite(p.y)));
        }
    }
    CHECK(medial_axis({}, 0.01).edges.empty());
    CHECK(medial_axis({to_polygon({{0, 0}, {0, 0}, {0, 0}})}, 0.01).edges.empty());
}

TEST_CASE("a strip is one line as long as its volume asks for", "[thin_parts]") {
    const ThinParts parts = thin_parts(box(6, 0.5), 0.6);
    REQUIRE(parts.lines.size() == 1);
    CHECK(parts.whole);
    CHECK(parts.area == Approx(3).epsilon(1e-3));
    const TaperedLine& line = parts.lines[0];
    REQUIRE(line.points.size() == 2);
    CHECK(line.points[0].y == Approx(0.25).margin(0.002));
    CHECK(std::abs(line.points[0].x - line.points[1].x) == Approx(5.75).margin(0.01));
    CHECK(thin_parts(box(6, 0.7), 0.6).lines.empty());
}

TEST_CASE("a wedge is a line that tapers, up to where it grows too thick", "[thin_parts]") {
    // 0.2 mm thick at one end and 1.0 at the other: 0.6 in the middle.
    const Polygons wedge{to_polygon({{0, -0.1}, {8, -0.5}, {8, 0.5}, {0, 0.1}})};
    const ThinParts parts = thin_parts(wedge, 0.6);
    REQUIRE(parts.lines.size() == 1);
    CHECK_FALSE(parts.whole);
    const TaperedLine& line = parts.lines[0];
    for (std::size_t i = 0; i < line.points.size(); ++i) {
        CHECK(line.points[i].y == Approx(0).margin(0.003));
        CHECK(line.thickness[i] == Approx(0.2 + 0.1 * line.points[i].x).margin(0.015));
    }
    const double far = std::max(line.points.front().x, line.points.back().x);
    CHECK(far == Approx(4).margin(0.03));
    CHECK(area_of(subtract_polygons(wedge, parts.covered)) == Approx(4 * 0.8).epsilon(0.01));
}

TEST_CASE("where walls meet, one passes and the others end at its flank", "[thin_parts]") {
    const Polygons tee{
        to_polygon({{-3, 0}, {3, 0}, {3, 0.5}, {0.25, 0.5}, {0.25, 4}, {-0.25, 4}, {-0.25, 0.5}, {-3, 0.5}})};
    const ThinParts parts = thin_parts(tee, 0.6);
    CHECK(parts.whole);
    REQUIRE(parts.lines.size() == 2);
    double sum = 0;
    for (const TaperedLine& line : parts.lines) sum += area_of(line);
    // The bar ends 0.125 mm before its ends; the leg, too, and 3/4 of the disc where they meet above its
    // centre: that one touches the lower border and both corners, 0.3125 mm from (0, 0.3125).
    CHECK(sum == Approx(0.5 * 5.75 + 0.5 * (3.875 - 1.75 * 0.3125)).epsilon(0.01));
    const auto width = [](const TaperedLine& line) {
        return std::abs(line.points.front().x - line.points.back().x);
    };
    CHECK(std::max(width(parts.lines[0]), width(parts.lines[1])) > 5.4);
    CHECK(std::min(width(parts.lines[0]), width(parts.lines[1])) < 0.01);
}

}  // namespace medial_axis_test
