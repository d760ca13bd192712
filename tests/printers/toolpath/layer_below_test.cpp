// What holds a point, against the even-odd rule over all contours.
#include "printers/toolpath/layer_below.h"

#include <catch2/catch.hpp>
#include <random>

#include "tests/printers/polygons/hand_made_contours.h"

namespace layer_below_test {

using namespace lamella;
using namespace lamella::test;

TEST_CASE("footing holds what lies over the layer below", "[footing]") {
    const double pitch = 0.1;
    std::vector<Contour> contours = {box_contour({0, 0}, {20, 12}), as_hole(disc_contour({6, 6}, 4), 0),
                                     disc_contour({6, 6}, 1.5), disc_contour({30, 3}, 2)};
    Polygons polygons;
    for (const Contour& contour : contours) polygons.push_back(to_polygon(contour.points));
    const LayerBelow footing(polygons, pitch);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> x(-3, 35), y(-3, 15);
    int held = 0, free = 0;
    for (int i = 0; i < 20000; ++i) {
        const dvec2 p(x(random), y(random));
        const bool in = inside(contours, p);
        // Rows are half a pitch off at most.
        if (inside(contours, p + dvec2(0, pitch)) != in || inside(contours, p - dvec2(0, pitch)) != in)
            continue;
        REQUIRE(footing.holds(p) == in);
        ++(in ? held : free);
    }
    CHECK(held > 5000);
    CHECK(free > 5000);
    CHECK_FALSE(LayerBelow({}, pitch).holds({0, 0}));
}

TEST_CASE("polygons near a place are all that can matter there", "[footing]") {
    Polygons many;
    for (int i = 0; i < 100; ++i)
        many.push_back(to_polygon(disc_contour({i % 10 * 3.0, i / 10 * 3.0}, 1).points));
    many.push_back(to_polygon(box_contour({-50, -50}, {-5, -5}).points));
    const PlacedPolygons placed(many);
    const Polygons region = {to_polygon(box_contour({2, 2}, {11, 8}).points)};
    const Polygons near = placed.near(box_of(region));
    CHECK(near.size() < 20);
    CHECK(area_of(subtract_polygons(region, near)) == Approx(area_of(subtract_polygons(region, many))));
    CHECK(box_of(Polygons{}).empty());
}

}  // namespace layer_below_test
