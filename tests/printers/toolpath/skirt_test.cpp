// Loops round two squares, by their lengths.
#include "printers/toolpath/skirt.h"

#include <catch2/catch.hpp>

namespace skirt_test {

using namespace lamella;

namespace {

ClipperLib::Path square(double x, double edge) {
    return to_polygon({{x, 0}, {x + edge, 0}, {x + edge, edge}, {x, edge}});
}

double length_of(const Bead& bead) {
    double sum = 0;
    for (std::size_t i = 0; i < bead.points.size(); ++i)
        sum += glm::distance(bead.points[i], bead.points[(i + 1) % bead.points.size()]);
    return sum;
}

}  // namespace

TEST_CASE("a brim touches and a skirt keeps its distance, from the outside in", "[skirt]") {
    ClipperLib::Path hole = square(14, 2);
    ClipperLib::ReversePath(hole);
    const Polygons standing{square(0, 10), square(13, 4), hole};
    const LineSettings line{0.5, 0.2, 0.02};
    ToolpathProfile profile;
    CHECK(skirt_beads(standing, profile, line).empty());
    CHECK(skirt_reach(profile, line) == 0);

    profile.brim = 2 * line.spacing();
    std::vector<Bead> beads = skirt_beads(standing, profile, line);
    REQUIRE(beads.size() == 4);  // two loops round each, none in the hole
    CHECK(skirt_reach(profile, line) == Approx(line.width + line.spacing()));
    double inner = 0;
    for (const Bead& bead : beads) {
        CHECK(bead.closed);
        CHECK(bead.role == Role::skirt);
    }
    for (std::size_t i = 2; i < 4; ++i) inner += length_of(beads[i]);
    // Sides as long as the squares', and a circle's worth of corners each, half a line outside.
    CHECK(inner == Approx(4 * 10 + 4 * 4 + 2 * 2 * pi * line.width / 2).epsilon(1e-3));

    profile.brim = 0;
    profile.skirt = 2;
    profile.skirt_distance = 5;
    beads = skirt_beads(standing, profile, line);
    REQUIRE(beads.size() == 2);  // 3 mm apart, both squares share a loop
    CHECK(length_of(beads[0]) > length_of(beads[1]));
    double least = 1e9;
    for (const dvec2& p : beads[1].points) least = std::min(least, p.x);
    CHECK(least == Approx(-5 - line.width / 2).margin(0.01));
    CHECK(skirt_reach(profile, line) == Approx(5 + line.width + line.spacing()));
}

}  // namespace skirt_test
