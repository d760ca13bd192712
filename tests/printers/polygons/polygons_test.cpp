// Offsets, cuts and simplification of polygons against closed forms.
#include "printers/polygons/polygons.h"

#include <catch2/catch.hpp>

#include "tests/printers/polygons/hand_made_contours.h"

namespace polygons_test {

using namespace lamella;
using namespace lamella::test;

namespace {

Polygons polygons(std::initializer_list<Contour> contours) {
    Polygons result;
    for (const Contour& contour : contours) result.push_back(to_polygon(contour.points));
    return result;
}
}  // namespace

TEST_CASE("a finely drawn disc loses points but not its size", "[polygons]") {
    for (const int corners : {300, 5000, 100000}) {
        const Polygons fine = polygons({disc_contour({1, 2}, 8, corners)});
        const Polygons simple = simplified(fine, 0.01);
        CAPTURE(corners, simple[0].size());
        CHECK(simple[0].size() < 160);
        CHECK(lamella::area_of(simple) == Approx(pi * 64).epsilon(0.0025));
        for (const dvec2 p : to_points(simple[0]))
            CHECK(glm::distance(p, dvec2(1, 2)) == Approx(8).epsilon(1e-5));
    }
    CHECK(simplified(polygons({box_contour({0, 0}, {1, 1e-4})}), 0.01).empty());
}

TEST_CASE("offsets of a square have the areas of the textbook", "[polygons]") {
    const Polygons square = polygons({box_contour({-5, -5}, {5, 5})});
    CHECK(lamella::area_of(offset_polygons(square, -1)) == Approx(64));
    CHECK(lamella::area_of(offset_polygons(square, 1)) == Approx(100 + 40 + pi).epsilon(1e-3));
    CHECK(offset_polygons(square, -5.001).empty());
    CHECK(perimeter_of(square) == Approx(40));
    CHECK(lamella::area_of(subtract_polygons(square, offset_polygons(square, -1))) == Approx(36));
}

TEST_CASE("pieces come with their holes, islands in holes too", "[polygons]") {
    const Polygons all = polygons({box_contour({0, 0}, {10, 10}), as_hole(box_contour({1, 1}, {9, 9}), 0),
                                   box_contour({3, 3}, {5, 5}), box_contour({20, 0}, {21, 1})});
    std::vector<double> areas;
    for (const Polygons& piece : split_pieces(all)) areas.push_back(lamella::area_of(piece));
    std::sort(areas.begin(), areas.end());
    REQUIRE(areas.size() == 3);
    CHECK(areas[0] == Approx(1));
    CHECK(areas[1] == Approx(4));
    CHECK(areas[2] == Approx(36));
    CHECK(split_pieces({}).empty());
}

TEST_CASE("lines are cut where the border is, also through vertices", "[polygons]") {
    const Polygons ring = polygons({box_contour({0, 0}, {4, 4}), as_hole(box_contour({1, 1}, {3, 3}), 0)});
    const auto cuts = cut_lines(ring, {1, 0}, 0, 1, 5);
    double length = 0;
    for (const Segment& cut : cuts) length += cut.length();
    // Lines 0 and 3 lie on lower edges and count as inside of them, 1 and 2 pass the hole, 4 is on the rim.
    CHECK(length == Approx(4 + 2 + 2 + 4));
    const Polygons disc = polygons({disc_contour({3, -2}, 2, 1000)});
    const dvec2 direction(0.6, 0.8);
    for (const Segment& cut : cut_lines(disc, direction, -20, 0.37, 200)) {
        const dvec2 middle = (cut.a + cut.b) * 0.5 - dvec2(3, -2);
        const double off = std::sqrt(glm::dot(middle, middle));
        CHECK(cut.length() / 2 == Approx(std::sqrt(4 - off * off)).margin(1e-3));
        CHECK(std::abs(glm::dot(middle, direction)) < 1e-3);
    }
}

TEST_CASE("the longest chord of a turned bar runs along it", "[polygons]") {
    for (double angle = 0; angle < 3.2; angle += 0.2) {
        const dvec2 along(std::cos(angle), std::sin(angle));
        const dvec2 across(-along.y, along.x);
        const Contour bar{{along * -3.0 - across * 0.1, along * 3.0 - across * 0.1,
                           along * 3.0 + across * 0.1, along * -3.0 + across * 0.1},
                          -1,
                          false};
        const Segment chord = longest_chord(polygons({bar}));
        CHECK(chord.length() == Approx(6).epsilon(1e-3));
        CHECK(std::abs(glm::dot(chord.b - chord.a, along)) == Approx(6).epsilon(1e-3));
    }
}

}  // namespace polygons_test
