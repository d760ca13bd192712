// SVG drawings: areas by closed forms and by another program, and what is refused.
#include "engine/io/svg_outline.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "engine/base/error.h"
#include "engine/io/svg_path.h"
#include "tests/app/commands/folder.h"
#include "tests/app/commands/mentions.h"

namespace svg_outline_test {

using namespace lamella;

namespace {

double area(const std::vector<dvec2>& polygon) {
    double sum = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i)
        sum += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
    return sum / 2;
}

double path_area(const std::string& data) {
    double sum = 0;
    for (const SvgSubpath& subpath : flattened_path(data, 1e-4, "p")) {
        CHECK(subpath.is_closed);
        sum += area(subpath.points);
    }
    return sum;
}

std::vector<std::vector<dvec2>> drawn(const std::string& inner, const std::string& attributes = "") {
    const Folder folder;
    write(folder / "d.svg", "<?xml version=\"1.0\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" " +
                                attributes + ">\n" + inner + "\n</svg>\n");
    return read_svg_outlines(folder / "d.svg", 1e-4);
}

std::string told(const std::string& inner) {
    try {
        drawn(inner);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

constexpr double mm = 25.4 / 96;

}  // namespace

TEST_CASE("paths enclose what their commands say", "[svg]") {
    CHECK(path_area("M0 0L4 0 4 3 0 3z") == Approx(12));
    CHECK(path_area("m1,1 4,0 0,3 -4,0Z") == Approx(12));
    CHECK(path_area("M0 0H4V3H0z") == Approx(12));
    CHECK(path_area("M.5.5h4v3h-4z m1 1h1v1h-1z") == Approx(13));
    CHECK(path_area("M 2 0 A 2 2 0 0 1 -2 0 A 2 2 0 0 1 2 0") == Approx(4 * pi).epsilon(1e-4));
    CHECK(path_area("M2 0a2 2 0 01-4 0 2 2 0 014 0z") == Approx(4 * pi).epsilon(1e-4));
    CHECK(path_area("M 3 0 A 3 1 0 1 1 0 -1 L 0 0 z") == Approx(0.75 * 3 * pi).epsilon(1e-4));
    CHECK(path_area("M0 3 A 3 1 90 1 1 0.0001 3 z") == Approx(3 * pi).epsilon(1e-3));
    // A parabola: 2/3 of its control triangle; as a cubic the same.
    CHECK(path_area("M0 0Q2 -3 4 0z") == Approx(4).epsilon(1e-4));
    CHECK(path_area("M0 0C1.3333333 -2 2.6666667 -2 4 0z") == Approx(4).epsilon(1e-4));
    CHECK(path_area("M0 0Q2 -3 4 0T8 0z") == Approx(0).margin(1e-4));
    CHECK(path_area("M0 0C0 -2 4 -2 4 0S8 2 8 0z") == Approx(0).margin(1e-4));
    CHECK(path_area("M0 0 1e1 0-1e0 5-1-5z") == Approx(path_area("M0 0L10 0L-1 5L-1 -5z")));
}

TEST_CASE("drawings have their sizes in mm, upward, about their middle", "[svg]") {
    const auto box = drawn("<rect x=\"10\" y=\"20\" width=\"40\" height=\"30\"/>");
    REQUIRE(box.size() == 1);
    CHECK(std::abs(area(box[0])) == Approx(1200 * mm * mm));
    CHECK(box[0][0].x == Approx(-20 * mm));
    CHECK(box[0][0].y == Approx(15 * mm));  // the upper edge is the lower number
    const std::string sized = "width=\"100mm\" height=\"50mm\" viewBox=\"0 0 200 100\"";
    CHECK(std::abs(area(drawn("<rect width=\"40\" height=\"30\"/>", sized)[0])) == Approx(300));
    CHECK(std::abs(area(drawn("<circle cx=\"3\" r=\"4\"/>", sized)[0])) == Approx(4 * pi).epsilon(1e-4));
    CHECK(std::abs(area(drawn("<ellipse rx=\"4\" ry=\"2mm\"/>")[0])) ==
          Approx(pi * 4 * mm * 2).epsilon(1e-3));
    const auto turned = drawn(
        "<g transform=\"translate(3 4) rotate(30) scale(2)\"><g transform=\"matrix(1 0 0.5 1 0 0)\">"
        "<polygon points=\"0,0 4,0 4,3 0,3\"/></g></g>",
        sized);
    CHECK(std::abs(area(turned[0])) == Approx(12 * 4 * 0.25));
    const auto several = drawn(
        "<defs><rect width=\"9\" height=\"9\"/></defs><rect width=\"2\" height=\"2\"/>"
        "<rect style=\"fill: none\" width=\"9\" height=\"9\"/><path d=\"M0 0H1V1z\"/>"
        "<g display=\"none\"><circle r=\"5\"/></g>");
    CHECK(several.size() == 2);
}

TEST_CASE("drawings that have no outline are told why", "[svg]") {
    CHECK(mentions(told("<path d=\"M0 0L1 0L1 1\"/>"), "d.svg:3: <path> is open"));
    CHECK(told("<path fill=\"none\" d=\"M0 0L1 0L1 1\"/><rect width=\"1\" height=\"1\"/>").empty());
    CHECK(mentions(told("<path d=\"L0 0\"/>"), "does not begin with M"));
    CHECK(mentions(told("<path d=\"M0 0L1 x\"/>"), "where a number below 1e9 belongs"));
    CHECK(mentions(told("<path d=\"M0 0z 4 4\"/>"), "where a command belongs"));
    CHECK(mentions(told("<path d=\"M0 0A1 1 0 2 0 1 1z\"/>"), "lacks a flag"));
    CHECK(mentions(told("<text>leaf</text>"), "has no outline of its own"));
    CHECK(mentions(told(""), "holds no filled shape"));
    CHECK(mentions(told("<rect width=\"5%\" height=\"1\"/>"), "has width=\"5%\""));
    CHECK(mentions(told("<g transform=\"turn(4)\"><rect width=\"5\" height=\"1\"/></g>"),
                   "accepted: translate"));
    CHECK(mentions(told("<polygon points=\"0 0 1\"/>"), "not pairs of numbers"));
    const Folder folder;
    write(folder / "d.svg", "solid leaf\n");
    CHECK_THROWS_AS(read_svg_outlines(folder / "d.svg", 0.01), InputError);
}

}  // namespace svg_outline_test
