// The largest disc of a piece, against closed forms and against erosion.
#include "printers/polygons/inscribed_disc.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <catch2/catch.hpp>

namespace inscribed_disc_test {

using namespace lamella;

namespace {

double distance_to(const std::vector<dvec2>& ring, dvec2 p) {
    double least = infinity;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const dvec2 a = ring[i], way = ring[(i + 1) % ring.size()] - a;
        const double t = std::clamp(glm::dot(p - a, way) / glm::dot(way, way), 0.0, 1.0);
        least = std::min(least, glm::distance(p, a + way * t));
    }
    return least;
}

}  // namespace

TEST_CASE("a disc fits as far as it touches three sides, or two and a hole", "[polygons]") {
    const Polygons box{to_polygon({{0, 0}, {6, 0}, {6, 1}, {0, 1}})};
    CHECK(InscribedDisc(box).fits(0.499));
    CHECK(!InscribedDisc(box).fits(0.501));
    Polygons with_hole{to_polygon({{0, 0}, {4, 0}, {4, 4}, {0, 4}})};
    with_hole.push_back(to_polygon({{1, 1}, {1, 3}, {3, 3}, {3, 1}}));
    // In a corner: as far from two sides as from the hole's corner, r = (1 - r) sqrt(2).
    const double corner = std::sqrt(2.0) / (1 + std::sqrt(2.0));
    CHECK(InscribedDisc(with_hole).fits(corner - 0.002));
    CHECK(!InscribedDisc(with_hole).fits(corner + 0.002));
}

TEST_CASE("a disc fits where erosion leaves something, and nowhere farther from the border than any point",
          "[polygons]") {
    std::mt19937 random(8);
    for (int trial = 0; trial < 60; ++trial) {
        const int corners = 5 + static_cast<int>(random() % 40);
        std::vector<dvec2> points;
        for (int i = 0; i < corners; ++i) {
            const double angle = 2 * pi * i / corners;
            points.push_back(std::uniform_real_distribution(0.3, 1.5)(random) *
                             dvec2(std::cos(angle), std::sin(angle)));
        }
        const Polygons star{to_polygon(points)};
        const InscribedDisc disc(star);
        constexpr double step = 0.02;
        double farthest = 0;  // from the border, of points inside on a grid
        for (double y = -1.5; y <= 1.5; y += step) {
            for (double x = -1.5; x <= 1.5; x += step) {
                if (ClipperLib::PointInPolygon(to_polygon({{x, y}})[0], star[0]) == 0) continue;
                farthest = std::max(farthest, distance_to(points, {x, y}));
            }
        }
        CAPTURE(trial);
        CHECK(disc.fits(farthest - 0.002));
        CHECK(!disc.fits(farthest + step));
        for (const double radius : {0.1, 0.2, 0.3, 0.4, 0.5, 0.6}) {
            CAPTURE(radius);
            if (!offset_polygons(star, -radius - 0.003).empty()) CHECK(disc.fits(radius));
        }
    }
}

}  // namespace inscribed_disc_test
