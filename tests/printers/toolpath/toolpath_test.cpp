// Beads stay inside, add up to the island's volume, and no island goes without.
#include "printers/toolpath/toolpath.h"

#include <catch2/catch.hpp>
#include <chrono>
#include <map>
#include <random>

#include "printers/polygons/polygons.h"
#include "tests/printers/polygons/hand_made_contours.h"
#include "tests/printers/toolpath/bead_length.h"

namespace toolpath_test {

using namespace lamella;
using namespace lamella::test;

namespace {

constexpr double height = 0.2;

double volume_of(const Toolpaths& paths) {
    double sum = 0;
    for (const Bead& bead : paths.beads) sum += bead_volume(bead, height);
    return sum;
}

/// Checks that all points along all beads lie inside the contours.
void check_inside(const std::vector<Contour>& contours, const Toolpaths& paths) {
    for (const Bead& bead : paths.beads) {
        REQUIRE(bead.points.size() >= 2);
        REQUIRE(bead.width > 0);
        REQUIRE(bead.width <= 0.45 * 1.5 + 1e-9);
        bool in = true;
        const std::size_t edges = bead.points.size() - (bead.closed ? 0 : 1);
        for (std::size_t i = 0; i < edges; ++i) {
            const dvec2 a = bead.points[i];
            const dvec2 b = bead.points[(i + 1) % bead.points.size()];
            for (const double t : {0.0, 0.25, 0.5, 0.75, 1.0}) in = in && inside(contours, a + (b - a) * t);
        }
        REQUIRE(in);
    }
}

}  // namespace

TEST_CASE("a bead's cross-section and width are inverse and join where it is round", "[toolpath]") {
    CHECK(bead_area(0.2, 0.2) == Approx(3.14159265 * 0.01));
    CHECK(bead_area(0.45, 0.2) == Approx(0.2 * 0.25 + 3.14159265 * 0.01));
    CHECK(bead_area(0.2 + 1e-12, 0.2) == Approx(bead_area(0.2 - 1e-12, 0.2)));
    for (const double width : {0.01, 0.1, 0.2, 0.3, 2.0})
        CHECK(bead_width(bead_area(width, 0.2), 0.2) == Approx(width));
}

TEST_CASE("at full density the plastic has the volume of the region", "[toolpath]") {
    const int layer = GENERATE(0, 1);
    const std::vector<std::vector<Contour>> shapes = {
        {box_contour({0, 0}, {20, 10})},
        {disc_contour({3, 4}, 10)},
        {disc_contour({0, 0}, 2)},
        {box_contour({0, 0}, {30, 30}), as_hole(disc_contour({15, 15}, 8), 0)},
        {box_contour({0, 0}, {30, 30}), as_hole(disc_contour({15, 15}, 12), 0), disc_contour({15, 15}, 9)},
    };
    for (const auto& contours : shapes) {
        double area = 0;
        for (const Contour& contour : contours) area += area_of(contour);
        const Toolpaths paths = plan_toolpaths(contours, {{0.45, height, 0.02}}, layer);
        CAPTURE(area);
        check_inside(contours, paths);
        CHECK(volume_of(paths) == Approx(area * height).epsilon(0.03));
        CHECK(paths.islands_left_out == 0);
    }
}

TEST_CASE("infill has its density and turns from layer to layer", "[toolpath]") {
    const std::vector<Contour> contours = {box_contour({0, 0}, {40, 40})};
    for (const double density : {0.1, 0.3, 0.6}) {
        CAPTURE(density);
        for (const int layer : {0, 1}) {
            const Toolpaths paths = plan_toolpaths(contours, {{0.45, height, 0.02}, 1, density}, layer);
            check_inside(contours, paths);
            double infill = 0;
            for (const Bead& bead : paths.beads) {
                if (bead.closed) continue;
                CHECK(bead.role == Role::internal_infill);
                infill += length_of(bead) * bead_area(bead.width, height);
                const dvec2 way = bead.points[1] - bead.points[0];
                CHECK(way.x * way.y * (layer == 0 ? 1 : -1) > 0);
                CHECK(std::abs(way.x) == Approx(std::abs(way.y)));
            }
            CHECK(infill / (40 * 40 * height) == Approx(density).epsilon(0.06));
        }
    }
    CHECK(plan_toolpaths(contours, {{0.45, height, 0.02}, 1, 0}, 0).beads.size() == 1);
}

TEST_CASE("no printable island goes without a bead, however thin or small", "[toolpath]") {
    std::vector<Contour> contours;
    double y = 0;
    for (double thickness = 0.02; thickness < 1.2; thickness *= 1.13) {
        const double length = std::max(3.0, 0.06 / thickness);
        contours.push_back(box_contour({0, y}, {length, y + thickness}));
        contours.push_back(arc_contour({20, y}, 2, thickness, 0.3, 2.8));
        contours.push_back(disc_contour({30, y}, std::max(thickness / 2, 0.13), 16));
        y += 6;
    }
    for (const Contour& island : contours) {
        const std::vector<Contour> alone = {island};
        const double area = area_of(island);
        CAPTURE(area, island.points[0].x, island.points[0].y);
        const Toolpaths paths = plan_toolpaths(alone, {{0.45, height, 0.02}}, 0);
        CHECK(paths.islands == 1);
        CHECK(paths.islands_left_out == (area < 0.45 * 0.45 / 4 ? 1 : 0));
        CHECK(paths.beads.empty() == (paths.islands_left_out == 1));
        check_inside(alone, paths);
        // Too little plastic is possible where an island is thinner than any bead, too much never is.
        CHECK(volume_of(paths) < area * height * 1.06);
    }
    const Toolpaths all = plan_toolpaths(contours, {{0.45, height, 0.02}}, 0);
    std::map<int, int> beads_of;
    for (const Bead& bead : all.beads) ++beads_of[bead.island];
    CHECK(beads_of.size() == contours.size() - static_cast<std::size_t>(all.islands_left_out));
}

TEST_CASE("strips from half a line width on get their volume", "[toolpath]") {
    for (double thickness = 0.23; thickness < 2; thickness += 0.05) {
        CAPTURE(thickness);
        const std::vector<Contour> strip = {arc_contour({0, 0}, 6, thickness, 0, 3)};
        const Toolpaths paths = plan_toolpaths(strip, {{0.45, height, 0.02}}, 0);
        check_inside(strip, paths);
        CHECK(volume_of(paths) == Approx(area_of(strip[0]) * height).epsilon(0.12));
    }
}

TEST_CASE("a thin arm of a thick island gets a bead of its own", "[toolpath]") {
    // A disc with a handle 0.35 mm thick: the wall ends where the handle begins.
    Contour shape = disc_contour({0, 0}, 3, 200);
    std::vector<dvec2> points;
    for (const dvec2 p : shape.points) {
        if (p.x < 2.99) points.push_back(p);
    }
    const double y = 0.175;
    const auto right = std::find_if(points.begin(), points.end(), [](dvec2 p) { return p.y > 0; });
    points.insert(right, {{2.99, -y}, {9, -y}, {9, y}, {2.99, y}});
    const std::vector<Contour> contours = {{points, -1, false}};
    const Toolpaths paths = plan_toolpaths(contours, {{0.45, height, 0.02}}, 0);
    check_inside(contours, paths);
    double reach = 0;
    for (const Bead& bead : paths.beads) {
        for (const dvec2 p : bead.points) reach = std::max(reach, p.x);
    }
    CHECK(reach > 8.5);
}

TEST_CASE("toolpaths depend on nothing but their arguments", "[toolpath]") {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> radius(0.1, 0.45);
    std::vector<Contour> contours;
    for (int i = 0; i < 400; ++i) contours.push_back(disc_contour({i % 20, i / 20}, radius(random), 24));
    const Toolpaths a = plan_toolpaths(contours, {}, 3);
    const Toolpaths b = plan_toolpaths(contours, {}, 3);
    REQUIRE(a.beads.size() == b.beads.size());
    for (std::size_t i = 0; i < a.beads.size(); ++i) REQUIRE(a.beads[i].points == b.beads[i].points);
    // Neighbours come after each other: the tour is not much longer than one step for each island.
    double travel = 0;
    for (std::size_t i = 1; i < a.beads.size(); ++i) {
        travel += glm::distance(a.beads[i - 1].points.front(), a.beads[i].points.front());
    }
    CHECK(travel < 1.6 * 400);
}

TEST_CASE("an empty layer has no beads", "[toolpath]") { CHECK(plan_toolpaths({}, {}, 0).beads.empty()); }

TEST_CASE("the pieces of a scaffold get their volume, thin walls in single lines", "[toolpath]") {
    const double angle = GENERATE(0.0, 0.3, 0.7853981633974483, 1.9);
    CAPTURE(angle);
    const auto plan = [&](Contour contour) {
        for (dvec2& p : contour.points)
            p = {p.x * std::cos(angle) - p.y * std::sin(angle),
                 p.x * std::sin(angle) + p.y * std::cos(angle)};
        const std::vector<Contour> contours = {contour};
        const Toolpaths paths = plan_toolpaths(contours, {{0.45, height, 0.025}}, 0);
        check_inside(contours, paths);
        CHECK(volume_of(paths) == Approx(area_of(contour) * height).epsilon(0.02));
        return paths;
    };
    const auto length = [](const Toolpaths& paths) {
        double sum = 0;
        for (const Bead& bead : paths.beads) sum += length_of(bead);
        return sum;
    };
    for (const double wall : {0.3, 0.45, 0.5}) {  // a pillar: two walls 2.5 mm long that cross
        CAPTURE(wall);
        const double w = wall / 2;
        const double l = 1.25;
        const Toolpaths cross = plan({{{w, -l},
                                       {w, -w},
                                       {l, -w},
                                       {l, w},
                                       {w, w},
                                       {w, l},
                                       {-w, l},
                                       {-w, w},
                                       {-l, w},
                                       {-l, -w},
                                       {-w, -w},
                                       {-w, -l}},
                                      -1,
                                      false});
        CHECK(cross.beads.size() == 2);
        CHECK(length(cross) < 5);
    }
    const Toolpaths bar = plan(box_contour({0, 0}, {12, 0.9}));
    REQUIRE(bar.beads.size() == 1);
    CHECK(bar.beads[0].closed);  // two lines along the bar, side by side
    CHECK(length(bar) == Approx(24).epsilon(0.01));
    for (const double diameter : {0.3, 0.45, 0.6, 0.8, 1.0}) {
        CAPTURE(diameter);
        CHECK(plan(disc_contour({3, 4}, diameter / 2)).beads.size() == 1);
    }
}

}  // namespace toolpath_test
