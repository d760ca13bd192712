// Walls of one thickness are walked along their middle, each once.
#include "printers/toolpath/center_lines.h"

#include <catch2/catch.hpp>
#include <random>

#include "tests/printers/polygons/hand_made_contours.h"

namespace center_lines_test {

using namespace lamella;
using namespace lamella::test;

namespace {

struct Stroke {
    dvec2 a;
    dvec2 b;
    double length() const { return glm::distance(a, b); }
};

/// The strokes as walls this thick with square ends, in one piece.
Polygons walls(const std::vector<Stroke>& strokes, double thickness) {
    ClipperLib::Clipper clipper;
    for (const Stroke& stroke : strokes) {
        const dvec2 along = (stroke.b - stroke.a) / stroke.length();
        const dvec2 side = dvec2(-along.y, along.x) * (thickness / 2);
        clipper.AddPath(to_polygon({stroke.a - side, stroke.b - side, stroke.b + side, stroke.a + side}),
                        ClipperLib::ptSubject, true);
    }
    Polygons piece;
    clipper.Execute(ClipperLib::ctUnion, piece, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
    return piece;
}

double distance_to(dvec2 p, const Stroke& stroke) {
    const dvec2 way = stroke.b - stroke.a;
    const double t = glm::clamp(glm::dot(p - stroke.a, way) / glm::dot(way, way), 0.0, 1.0);
    return glm::distance(p, stroke.a + way * t);
}

std::vector<Stroke> strokes_of(const std::vector<CenterLine>& lines) {
    std::vector<Stroke> strokes;
    for (const CenterLine& line : lines) {
        for (std::size_t i = line.closed ? 0 : 1; i < line.points.size(); ++i)
            strokes.push_back({line.points[i == 0 ? line.points.size() - 1 : i - 1], line.points[i]});
    }
    return strokes;
}

/// The largest distance from points along `from` to the nearest of `to`.
double farthest(const std::vector<Stroke>& from, const std::vector<Stroke>& to) {
    double most = 0;
    for (const Stroke& stroke : from) {
        for (int i = 0; i <= 50; ++i) {
            const dvec2 p = stroke.a + (stroke.b - stroke.a) * (i / 50.0);
            double least = infinity;
            for (const Stroke& other : to) least = std::min(least, distance_to(p, other));
            most = std::max(most, least);
        }
    }
    return most;
}

double total(const std::vector<Stroke>& strokes) {
    double sum = 0;
    for (const Stroke& stroke : strokes) sum += stroke.length();
    return sum;
}

std::vector<Stroke> star(int arms, double length, double angle) {
    std::vector<Stroke> strokes;
    for (int i = 0; i < arms; ++i) {
        const double a = angle + 2 * 3.14159265358979 * i / arms;
        strokes.push_back({{1, 2}, dvec2(1, 2) + length * dvec2(std::cos(a), std::sin(a))});
    }
    return strokes;
}

/// A net of square cells.
std::vector<Stroke> net(int cells, double pitch) {
    std::vector<Stroke> strokes;
    for (int i = 0; i <= cells; ++i) {
        strokes.push_back({{-1.5, i * pitch}, {cells * pitch + 1.5, i * pitch}});
        strokes.push_back({{i * pitch, -1.5}, {i * pitch, cells * pitch + 1.5}});
    }
    return strokes;
}

}  // namespace

TEST_CASE("the thickness of walls follows from area and outline", "[center_lines]") {
    CHECK(wall_thickness(walls({{{0, 0}, {3, 4}}}, 0.45)) == Approx(0.45).epsilon(1e-3));
    CHECK(wall_thickness(walls({{{-2, 0}, {2, 0}}, {{0, -1}, {0, 1}}}, 0.3)) == Approx(0.3).epsilon(1e-3));
    CHECK(wall_thickness(walls(net(3, 2), 0.4)) == Approx(0.4).epsilon(1e-3));
    CHECK(wall_thickness({to_polygon(disc_contour({0, 0}, 3, 400).points)}) == Approx(6).epsilon(0.01));
}

TEST_CASE("a line runs along every wall once, however they branch", "[center_lines]") {
    const double thickness = GENERATE(0.05, 0.25, 0.45, 0.8);
    const double angle = GENERATE(0.0, 0.31, 0.7853981633974483, 2.2);
    CAPTURE(thickness, angle);
    const std::vector<std::vector<Stroke>> shapes = {
        star(1, 3, angle),
        star(2, 3, angle),
        star(3, 3, angle),
        star(4, 2, angle),
        net(1, 3),
        net(4, 2.5),
        // A T, and a comb.
        {{{0, 0}, {6, 0}}, {{3, 0}, {3, 3}}},
        {{{0, 0}, {8, 0}}, {{0, 0}, {0, 3}}, {{4, 0}, {4, 3}}, {{8, 0}, {8, 3}}}};
    for (const auto& strokes : shapes) {
        const Polygons piece = walls(strokes, thickness);
        CAPTURE(strokes.size(), strokes.front().b.x, strokes.front().b.y);
        const auto lines = center_lines(piece, thickness, 0.02);
        REQUIRE(!lines.empty());
        const auto found = strokes_of(lines);
        CHECK(farthest(found, strokes) < 0.2 * thickness);
        CHECK(farthest(strokes, found) < 0.45 * thickness);  // they end a quarter before the walls
        // Twice along a wall would double the length.
        CHECK(total(found) < total(strokes) * 1.02);
        CHECK(total(found) > total(strokes) * 0.85);
    }
}

TEST_CASE("rings are closed lines", "[center_lines]") {
    const std::vector<Contour> ring = {disc_contour({0, 0}, 5.2, 300),
                                       as_hole(disc_contour({0, 0}, 4.8, 300), 0)};
    const auto lines = center_lines({to_polygon(ring[0].points), to_polygon(ring[1].points)}, 0.4, 0.02);
    REQUIRE(lines.size() == 1);
    CHECK(lines[0].closed);
    CHECK(length_of(lines[0]) == Approx(2 * 3.14159265 * 5).epsilon(0.01));
    for (const dvec2 p : lines[0].points) CHECK(std::sqrt(p.x * p.x + p.y * p.y) == Approx(5).margin(0.03));
}

TEST_CASE("walls with rough sides keep their center line", "[center_lines]") {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> noise(-0.012, 0.012);
    for (int round = 0; round < 20; ++round) {
        CAPTURE(round);
        Contour strip = arc_contour({0, 0}, 6, 0.45, 0, 3);
        for (dvec2& p : strip.points) p += dvec2(noise(random), noise(random));
        const Polygons piece = {to_polygon(strip.points)};
        const auto lines = center_lines(piece, wall_thickness(piece), 0.025);
        REQUIRE(lines.size() == 1);
        CHECK(!lines[0].closed);
        CHECK(length_of(lines[0]) == Approx(18).epsilon(0.03));
        for (const dvec2 p : lines[0].points)
            CHECK(std::sqrt(p.x * p.x + p.y * p.y) == Approx(6).margin(0.06));
    }
}

TEST_CASE("pieces that are no walls of one thickness have no center lines", "[center_lines]") {
    const auto none = [](const std::vector<dvec2>& points) {
        const Polygons piece = {to_polygon(points)};
        return center_lines(piece, wall_thickness(piece), 0.02).empty();
    };
    CHECK(none({{0, -0.05}, {8, -0.5}, {8, 0.5}, {0, 0.05}}));  // a wedge
    CHECK(none(disc_contour({0, 0}, 0.3).points));
    CHECK(none({{0, 0}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}}));
    // A drop on a stalk.
    CHECK(none({{0, 0}, {5, 0}, {5, -0.5}, {6.4, -0.5}, {6.4, 0.9}, {5, 0.9}, {5, 0.4}, {0, 0.4}}));
    CHECK(center_lines({}, 0.4, 0.02).empty());
    CHECK(center_lines(walls({{{0, 0}, {5, 0}}}, 0.4), 0, 0.02).empty());
}

TEST_CASE("lines through any tangle of walls lie in it and carry its area", "[center_lines]") {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(0, 12);
    std::uniform_int_distribution<int> number(2, 9);
    int found = 0;
    for (int round = 0; round < 300; ++round) {
        CAPTURE(round);
        std::vector<Stroke> strokes;
        for (int i = number(random); i > 0; --i)
            strokes.push_back({{place(random), place(random)}, {place(random), place(random)}});
        for (const Polygons& piece : split_pieces(walls(strokes, 0.45))) {
            const double thickness = wall_thickness(piece);
            const auto lines = center_lines(piece, thickness, 0.02);
            if (lines.empty()) continue;  // sharp crossings are thicker than walls
            ++found;
            double length = 0;
            for (const CenterLine& line : lines) {
                length += length_of(line);
                REQUIRE(line.points.size() >= 2);
                for (const dvec2 p : line.points) {
                    bool inside = false;
                    for (const ClipperLib::Path& path : piece) {
                        const int hit = ClipperLib::PointInPolygon(to_polygon({p}).front(), path);
                        inside = inside != (hit != 0);
                    }
                    REQUIRE(inside);
                }
            }
            CHECK(length * thickness == Approx(area_of(piece)).epsilon(0.35));
        }
    }
    CHECK(found > 100);
}

}  // namespace center_lines_test
