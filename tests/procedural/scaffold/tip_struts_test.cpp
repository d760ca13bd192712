// Struts below tips, held against the shortest ways that boxes leave.
#include "procedural/scaffold/tip_struts.h"

#include <cmath>

#include <catch2/catch.hpp>

#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"

namespace tip_struts_test {

using namespace lamella;

namespace {

const FieldPtr body = make_box({{-10, -10, -1}, {10, 10, 10}});
const FieldPtr plate = make_box({{-10, -10, 3}, {10, 10, 4}});  // hangs over the rest
constexpr dvec3 tip{0, 0, 3.025};

std::optional<Beam> strut(const FieldPtr& below, const FieldPtr& within = body) {
    return strut_below(tip, *make_union({plate, below}), *within, TipStrutOptions());
}

}  // namespace

TEST_CASE("a strut goes straight down where solid lies below", "[supports]") {
    const auto found = strut(make_box({{-10, -10, -1}, {10, 10, 0}}));
    REQUIRE(found);
    CHECK(found->a == tip);
    CHECK(found->ra == 0.4);
    CHECK(glm::length(dvec2(found->b)) < 1e-9);
    CHECK(found->b.z < 0);
    CHECK(found->b.z == Approx(-0.2).margin(0.06));
    CHECK(found->rb == 0.2);
}

TEST_CASE("a strut leans no more than 45 degrees, to what is nearest so", "[supports]") {
    // A wall 2 mm aside, and one 1 mm aside on the other side that is lower.
    const FieldPtr near = make_box({{2, -10, -1}, {10, 10, 2}});
    const auto leaning = strut(near);
    REQUIRE(leaning);
    const dvec3 way = leaning->b - leaning->a;
    CHECK(glm::length(dvec2(way)) <= -way.z * (1 + 1e-9));
    CHECK(near->value(leaning->b) < 0);
    const auto shorter = strut(make_union({near, make_box({{-10, -10, -1}, {-1, 10, 2}})}));
    REQUIRE(shorter);
    CHECK(shorter->b.x < -1);
    CHECK(glm::length(shorter->b - tip) < glm::length(way));
    // At 45 degrees the ray sinks below the top of this one before it is there.
    CHECK(!strut(make_box({{5, -10, 0}, {10, 10, 2}})));
}

TEST_CASE("no strut leaves the body, is too long, or stands on too little", "[supports]") {
    const FieldPtr floor = make_box({{-10, -10, -1}, {10, 10, 0}});
    CHECK(!strut(floor, make_difference(body, make_box({{-10, -10, 1}, {10, 10, 2}}))));
    CHECK(!strut_below(tip, *make_union({plate, floor}), *body, {.radius = 0.4, .reach = 2.9}));
    CHECK(!strut(make_box({{-10, -10, 1}, {10, 10, 1.25}})));
    CHECK(!strut(make_empty()));
}

TEST_CASE("solid beside a tip is no solid below it", "[supports]") {
    // A wall from the bed to the plate's middle: the strut meets it below the first layer, not within.
    const auto found = strut(make_box({{0.01, -10, -1}, {10, 10, 3.5}}));
    REQUIRE(found);
    CHECK(found->a.z - found->b.z > 0.05);
}

TEST_CASE("a tip close above the bed gets a strut to where the body stands on the bed", "[supports]") {
    const FieldPtr ball = make_sphere({0, 0, 10}, 10);
    constexpr double first_plane = 0.025;
    const double footprint = std::sqrt(2 * 10 * first_plane - first_plane * first_plane);
    const dvec3 foot{1.1, 0, 0.075};  // within the ball, beside its footprint
    const auto found = struts_to_bed(foot, first_plane, *ball, TipStrutOptions());
    REQUIRE(found.size() == 1);
    CHECK(found[0].a == foot);
    CHECK(found[0].b.x == Approx(footprint - 0.1).margin(0.11));
    CHECK(std::abs(found[0].b.y) < 1e-9);
    CHECK(std::abs(found[0].b.z) < 1e-9);
    CHECK(found[0].rb == 0.4);
    // Far away, the small footprint is found as well.
    const auto farther = struts_to_bed({-1.9, 1.9, 0.37}, 0.31, *ball, {.radius = 0.2});
    REQUIRE(farther.size() == 1);
    CHECK(glm::length(dvec2(farther[0].b)) <= std::sqrt(2 * 10 * 0.31));
    // No bed in reach, too high above it, or a body that hangs above it.
    CHECK(struts_to_bed(foot, first_plane, *ball, {.radius = 0.4, .reach = 0.2}).empty());
    CHECK(struts_to_bed({1.1, 0, 0.23}, first_plane, *ball, TipStrutOptions()).empty());
    CHECK(
        struts_to_bed(foot, first_plane, *make_box({{-5, -5, 0.03}, {5, 5, 5}}), TipStrutOptions()).empty());
}

TEST_CASE("a strut to the bed goes round a corner of the body in legs", "[supports]") {
    // An L whose far end alone stands on the bed, and the same with a slit through its second arm.
    const FieldPtr arms =
        make_union({make_box({{-1, -1, 0.05}, {3, 1.02, 5}}), make_box({{1.98, -1, 0.05}, {3, 3, 5}})});
    const FieldPtr bent = make_union({arms, make_box({{1.98, 1.98, -1}, {3, 3, 5}})});
    constexpr double first_plane = 0.025;
    const dvec3 foot{0, 0.5, 0.075};
    const auto legs = struts_to_bed(foot, first_plane, *bent, TipStrutOptions());
    REQUIRE(legs.size() >= 2);
    REQUIRE(legs.size() <= 3);  // the grid may have two bends at the corner
    CHECK(legs.front().a == foot);
    CHECK(legs.back().b.y == Approx(2).margin(0.051));
    CHECK(legs.back().b.z == Approx(0));
    CHECK(legs.back().rb == 0.4);
    double length = 0;
    for (std::size_t i = 0; i < legs.size(); ++i) {
        length += glm::length(dvec2(legs[i].b - legs[i].a));
        if (i + 1 == legs.size()) continue;
        CHECK(legs[i].b == legs[i + 1].a);
        CHECK(legs[i].rb == 0.4);
        CHECK(legs[i].b.z == foot.z);
        CHECK(glm::length(dvec2(legs[i].b) - dvec2(2, 1)) < 0.12);  // the inner corner
    }
    CHECK(length == Approx(std::hypot(2, 0.5) + 1).margin(0.15));
    const FieldPtr slit = make_box({{1, 1.4, -2}, {4, 1.6, 6}});
    CHECK(struts_to_bed(foot, first_plane, *make_difference(bent, slit), TipStrutOptions()).empty());
}

TEST_CASE("a strut goes aside to solid that stands", "[supports]") {
    // A tab that begins at 3 in the air, a column 1 mm beside it, and a nearer piece that hangs as well.
    const FieldPtr tab = make_box({{-1, -1, 3}, {1, 1, 4}});
    const FieldPtr column = make_box({{2, -1, -1}, {4, 1, 4}});
    const FieldPtr hanging = make_box({{-3, -1, 2.9}, {-2, 1, 4}});
    const FieldPtr part = make_union({tab, column, hanging});
    const auto legs = struts_aside(tip, *part, *body, TipStrutOptions());
    REQUIRE(legs.size() == 1);
    CHECK(legs[0].a == tip);
    CHECK(legs[0].b.x == Approx(2).margin(0.051));
    CHECK(std::abs(legs[0].b.y) < 1e-9);
    CHECK(legs[0].b.z == tip.z);
    CHECK(legs[0].rb == 0.4);
    // Too far, nothing that stands, or a gap in the body on the way.
    CHECK(struts_aside(tip, *part, *body, {.radius = 0.4, .reach = 1.9}).empty());
    CHECK(struts_aside(tip, *make_union({tab, hanging}), *body, TipStrutOptions()).empty());
    const FieldPtr slit = make_box({{1.5, -20, -2}, {1.7, 20, 20}});
    CHECK(struts_aside(tip, *part, *make_difference(body, slit), TipStrutOptions()).empty());
}

}  // namespace tip_struts_test
