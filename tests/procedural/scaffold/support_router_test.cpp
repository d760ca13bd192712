// Legs lead down by the shortest way that there is, and stand on the bed or on floors.
#include "procedural/scaffold/support_router.h"

#include <catch2/catch.hpp>
#include <random>

#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"

namespace support_router_test {

using namespace lamella;

namespace {

FieldPtr box(dvec3 lo, dvec3 hi) { return make_box({lo, hi}); }

/// A plate whose lower side is at z.
FieldPtr plate(double z, double half = 12) { return box({-half, -half, z}, {half, half, z + 2}); }

struct Case {
    FieldPtr part;
    ScaffoldShape shape;
    std::optional<Leg> under(dvec3 point) const {
        const FreeSpace space(*part, shape.bed);
        return SupportRouter(space, shape).under_point(point);
    }
};

/// The least room along a leg's pieces beyond their radius, from 3 mm away from contacts on, by sampling.
double min_room(const Case& scene, const Leg& leg, dvec3 point) {
    constexpr double about_contact = 3;
    double least = infinity;
    const auto ask = [&](dvec3 a, dvec3 b, double ra, double rb) {
        for (int k = 0; k <= 200; ++k) {
            const double share = k / 200.0;
            const dvec3 p = a + (b - a) * share;
            if (glm::distance(p, point) < about_contact) continue;
            if (!leg.on_bed && p.z - leg.landing < about_contact) continue;
            least = std::min(least, scene.part->value(p) - (ra + (rb - ra) * share));
        }
    };
    for (const Beam& beam : leg.connectors) ask(beam.a, beam.b, beam.ra, beam.rb);
    if (leg.pillar) {
        const double half = scene.shape.pillar / 2;
        ask({leg.pillar->at, leg.pillar->bottom}, {leg.pillar->at, leg.pillar->top}, half, half);
    }
    return least;
}

/// That pieces follow each other from the point down to where the leg stands.
void check_joined(const Leg& leg, dvec3 point, double bed) {
    dvec3 at = point;
    double length = 0;
    std::vector<Beam> left = leg.connectors;
    while (true) {
        const auto next = std::find_if(left.begin(), left.end(),
                                       [&](const Beam& beam) { return glm::distance(beam.a, at) < 1e-9; });
        if (next == left.end()) break;
        length += glm::distance(next->a, next->b);
        at = next->b;
        left.erase(next);
    }
    if (leg.pillar && !left.empty()) {
        // The cone under a pillar that stands on the part.
        REQUIRE(left.size() == 1);
        CHECK(glm::distance(left[0].b, dvec3(leg.pillar->at, leg.pillar->bottom)) < 1e-9);
        CHECK(left[0].a.z == Approx(leg.landing));
        length += glm::distance(left[0].a, left[0].b);
    } else {
        CHECK(left.empty());
    }
    if (leg.pillar) {
        CHECK(glm::distance(dvec2(at), leg.pillar->at) < 1e-9);
        CHECK(leg.pillar->top >= at.z - 1e-9);
        length += at.z - leg.pillar->bottom;
        at.z = left.empty() ? leg.pillar->bottom : left[0].a.z;
    }
    CHECK(at.z == Approx(leg.landing).margin(1e-9));
    if (leg.on_bed) CHECK(leg.landing == bed);
    CHECK(leg.length == Approx(length).margin(0.41));  // a strut's foot is not counted twice
}

}  // namespace

TEST_CASE("a leg leads straight down where nothing is in the way", "[scaffold]") {
    const Case scene{plate(15), {}};
    const dvec3 point(1, -2, 15);
    const auto leg = scene.under(point);
    REQUIRE(leg);
    CHECK(leg->on_bed);
    CHECK(leg->landing == 0);
    REQUIRE(leg->pillar);
    CHECK(leg->pillar->at == dvec2(point));
    CHECK(leg->pillar->bottom == 0);
    CHECK(leg->pillar->foot == scene.shape.foot / 2);
    REQUIRE(leg->connectors.size() == 1);
    CHECK(leg->connectors[0].ra == scene.shape.tip / 2);
    CHECK(leg->connectors[0].a == point);
    CHECK(leg->length == Approx(15));
    check_joined(*leg, point, 0);
}

TEST_CASE("a gap lies between the tip and the part when one is asked for", "[scaffold]") {
    Case scene{plate(15), {}};
    scene.shape.gap = 0.2;
    const auto leg = scene.under({0, 0, 15});
    REQUIRE(leg);
    const Beam& tip = leg->connectors[0];
    CHECK(tip.a.z + tip.ra == Approx(15 - 0.2));
    CHECK(signed_distance(tip, {0, 0, 15}) == Approx(0.2));
}

TEST_CASE("a leg takes a detour round what is in the way, to the bed", "[scaffold]") {
    const Case scene{make_union({plate(15), make_sphere({0, 0, 5}, 2)}), {}};
    for (const dvec3 point : {dvec3(0, 0, 15), dvec3(0.5, -0.3, 15), dvec3(2.5, 0, 15), dvec3(-1, 2, 15)}) {
        const auto leg = scene.under(point);
        REQUIRE(leg);
        CHECK(leg->on_bed);
        REQUIRE(leg->pillar);
        const double lateral = glm::distance(leg->pillar->at, dvec2(point));
        CHECK(lateral > 0.5);
        CHECK(lateral <= 2 * scene.shape.reach + 1e-9);
        for (const Beam& beam : leg->connectors) {
            const double aside = glm::distance(dvec2(beam.a), dvec2(beam.b));
            CHECK(aside <= scene.shape.lean * std::abs(beam.a.z - beam.b.z) + 1e-9);
        }
        CHECK(min_room(scene, *leg, point) >= scene.shape.clearance - 0.05);
        check_joined(*leg, point, 0);
    }
}

TEST_CASE("a leg stands on the part where the bed is out of reach", "[scaffold]") {
    const Case scene{make_union({plate(22), box({-30, -30, 2}, {30, 30, 5})}), {}};
    const dvec3 point(3, 4, 22);
    const auto leg = scene.under(point);
    REQUIRE(leg);
    CHECK_FALSE(leg->on_bed);
    CHECK(leg->landing == Approx(5).margin(0.03));
    REQUIRE(leg->pillar);
    CHECK(leg->pillar->foot == 0);
    CHECK(leg->pillar->bottom >= 5 + scene.shape.connector);
    CHECK(min_room(scene, *leg, point) >= scene.shape.clearance - 0.05);
    check_joined(*leg, point, 0);
    // A low one stands on a thin strut, which leaves a smaller mark.
    const Case low{make_union({plate(9), box({-30, -30, 2}, {30, 30, 5})}), {}};
    const auto strut = low.under({3, 4, 9});
    REQUIRE(strut);
    CHECK_FALSE(strut->pillar);
    CHECK(strut->length == Approx(4).margin(0.05));
    for (const Beam& beam : strut->connectors) CHECK(std::max(beam.ra, beam.rb) <= low.shape.bar_width / 2);
    check_joined(*strut, {3, 4, 9}, 0);
}

TEST_CASE("a thin strut goes where a pillar has no room", "[scaffold]") {
    // A shaft 2.4 mm wide: room for a strut 0.9 mm thick with 0.5 mm on either side, not for a pillar.
    const FieldPtr block = box({-12, -12, 0}, {12, 12, 10});
    const Case scene{make_difference(block, box({-1.2, -12.5, -1}, {1.2, 12.5, 8})), {}};
    const auto leg = scene.under({0, 2, 8});
    REQUIRE(leg);
    CHECK(leg->on_bed);
    for (const Beam& beam : leg->connectors) CHECK(std::max(beam.ra, beam.rb) <= scene.shape.bar_width / 2);
    CHECK(min_room(scene, *leg, {0, 2, 8}) >= scene.shape.clearance - 0.05);
}

TEST_CASE("nothing leads out of a place that is closed all round", "[scaffold]") {
    const FieldPtr block = box({-12, -12, 0}, {12, 12, 12});
    // A slot so narrow that not even a strut keeps its distance in it.
    const Case slot{make_difference(block, box({-0.4, -12.5, -1}, {0.4, 12.5, 10})), {}};
    CHECK_FALSE(slot.under({0, 0, 10}));
    const Case solid{block, {}};
    CHECK_FALSE(solid.under({0, 0, 6}));
    CHECK_FALSE(solid.under({0, 0, 11.9}));
    // In a closed cavity there is a floor to stand on.
    const Case cavity{make_difference(block, box({-6, -6, 3}, {6, 6, 9})), {}};
    const auto inside = cavity.under({0, 0, 9});
    REQUIRE(inside);
    CHECK_FALSE(inside->on_bed);
    CHECK(inside->landing == Approx(3).margin(0.03));
}

TEST_CASE("legs stand on floors and not on walls", "[scaffold]") {
    // A valley between two slopes, under a ball.
    const auto valley = [](double degrees) {
        const double a = degrees * 3.14159265358979323846 / 180;
        const Box all{{-60, -60, -5}, {60, 60, 60}};
        return make_intersection(
            {make_box(all), make_union({make_half_space({-std::sin(a), 0, std::cos(a)}, 0),
                                        make_half_space({std::sin(a), 0, std::cos(a)}, 0)})});
    };
    ScaffoldShape shape;
    shape.bed = -5;
    const auto leg_between = [&](double degrees) {
        const Case scene{make_union({valley(degrees), make_sphere({0, 0, 15}, 1)}), shape};
        return scene.under({0, 0, 14});
    };
    for (const double gentle : {0.0, 15.0, 30.0}) {
        INFO("slopes of " << gentle << " degrees");
        const auto leg = leg_between(gentle);
        REQUIRE(leg);
        CHECK_FALSE(leg->on_bed);
        CHECK(std::abs(leg->landing) < 3);
    }
    for (const double steep : {70.0, 75.0}) {
        INFO("slopes of " << steep << " degrees");
        CHECK_FALSE(leg_between(steep));
    }
}

TEST_CASE("what stands close above the bed needs no more than a post", "[scaffold]") {
    for (const double z : {0.1, 0.2, 0.4}) {
        const Case scene{plate(z), {}};
        const auto leg = scene.under({0, 0, z});
        REQUIRE(leg);
        CHECK(leg->on_bed);
        CHECK_FALSE(leg->pillar);
        REQUIRE(leg->connectors.size() == 1);
        CHECK(leg->connectors[0].b == dvec3(0, 0, 0));
        CHECK(leg->length == Approx(z));
    }
}

TEST_CASE("a strut's lower side leans no more than layers can follow, whatever it stands on", "[scaffold]") {
    // A ball over a hole in a floor: whatever stands on the floor has to lean.
    const FieldPtr floor =
        make_difference(box({-30, -30, 0}, {30, 30, 4}), make_cylinder({0, 0, -1}, {0, 0, 5}, 3));
    std::mt19937 random(8);
    std::uniform_real_distribution<double> place(-6, 6), height(5, 14);
    int leaning = 0;
    for (int k = 0; k < 200; ++k) {
        const dvec3 at(place(random), place(random), height(random));
        const Case scene{make_union({floor, make_sphere(at, 0.8)}), {}};
        const FreeSpace space(*scene.part, 0);
        const auto leg = SupportRouter(space, scene.shape).under_bar(at - dvec3(0, 0, 2.5));
        if (!leg || leg->on_bed) continue;
        for (const Beam& beam : leg->connectors) {
            const dvec3 way = beam.b - beam.a;
            const double length = std::sqrt(glm::dot(way, way));
            if (beam.a.z <= beam.b.z || beam.ra <= beam.rb) continue;
            const double lean = std::acos(-way.z / length) + std::asin((beam.ra - beam.rb) / length);
            if (way.x != 0 || way.y != 0) ++leaning;
            CHECK(std::tan(lean) <= scene.shape.lean * (1 + 1e-9));
        }
    }
    CHECK(leaning > 10);
}

}  // namespace support_router_test
