// Shapes of elements: cuts against distances, contents against closed forms, and mistakes.
#include "procedural/elements/element_shape.h"

#include <catch2/catch.hpp>
#include <random>

#include "engine/base/error.h"
#include "engine/solids/primitives.h"
#include "procedural/elements/distance_table.h"
#include "tests/app/commands/mentions.h"

namespace element_shape_test {

using namespace lamella;

namespace {

struct Named {
    const char* name;
    ElementShapePtr shape;
};

std::vector<Named> all_shapes() {
    return {{"stick", make_stick(6, 1.5)},
            {"ring", make_ring(5, 1.2)},
            {"star", make_outline({{{3, 0}, {0.5, 0.6}, {0, 3}, {-0.7, 0.5}, {-3, 0}, {0, -1}}}, 1.4)},
            {"frame",
             make_outline({{{-2, -2}, {2, -2}, {2, 2}, {-2, 2}}, {{-1, -1}, {-1, 1}, {1, 1}, {1, -1}}}, 1)},
            {"box", make_field_shape(make_box({dvec3(-2, -1, -0.5), dvec3(2, 1, 0.5)}))}};
}

}  // namespace

TEST_CASE("a line is cut where the distance of an element's shape says", "[elements]") {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(-3, 3), part(-1, 1);
    for (const Named& named : all_shapes()) {
        INFO(named.name);
        std::size_t cut = 0, several = 0;
        for (int k = 0; k < 400; ++k) {
            const bool is_in_plane = k % 6 == 0;  // as in a plate
            const dvec3 p(place(random), place(random), is_in_plane ? 0 : 0.4 * place(random));
            const dvec3 way(2 * part(random), part(random), k % 3 == 0 ? 0 : part(random));
            std::vector<Interval> inside;
            named.shape->cut(p, way, inside);
            cut += inside.empty() ? 0 : 1;
            several += inside.size() > 1 ? 1 : 0;
            double last = -infinity;
            for (const Interval& i : inside) {
                REQUIRE(i.lo > last);
                REQUIRE(i.hi > i.lo);
                last = i.hi;
            }
            for (double t = -8; t < 8; t += 0.07) {
                const double distance = named.shape->distance(p + t * way);
                if (std::abs(distance) < 2e-3 * length(way)) continue;
                const bool is_cut =
                    std::ranges::any_of(inside, [&](const Interval& i) { return i.contains(t); });
                REQUIRE(is_cut == (distance < 0));
            }
        }
        CHECK(cut > 60);
        if (named.name != std::string("stick") && named.name != std::string("box")) CHECK(several > 5);
    }
}

TEST_CASE("a table has the contents, thickness and reach of its shape", "[elements]") {
    const DistanceTable flat(*make_stick(10, 2), 1, 200, true), stick(*make_stick(10, 2), 1, 80, false),
        ring(*make_ring(8, 2), 1, 80, false);
    CHECK(flat.content() == Approx(16 + pi).epsilon(0.002));
    CHECK(stick.content() == Approx(pi * 8 + 4 * pi / 3).epsilon(0.01));
    CHECK(ring.content() == Approx(2 * pi * pi * 3).epsilon(0.01));  // 2 pi R times pi r^2
    CHECK(flat.thickness() == Approx(2).epsilon(0.05));
    CHECK(ring.thickness() == Approx(2).epsilon(0.1));
    CHECK(flat.reach() >= 5);
    CHECK(flat.at(dvec3(2, 0.7, 0)).distance == Approx(-0.3).margin(0.02));
    CHECK(flat.at(dvec3(2, 0.7, 0)).gradient.y == Approx(1).margin(0.02));
    CHECK(flat.at(dvec3(20, 0, 0)).distance == infinity);
}

TEST_CASE("shapes of elements that are none are refused", "[elements]") {
    const auto message = [](const auto& make) -> std::string {
        try {
            make();
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    CHECK(mentions(message([] { make_stick(2, 2); }), "not longer than it is wide"));
    CHECK(mentions(message([] { make_ring(2, 1); }), "without a hole"));
    CHECK(mentions(message([] { make_outline({{{0, 0}, {1, 0}}}, 1); }), "fewer than three corners"));
    CHECK(mentions(message([] { make_outline({{{0, 0}, {1, 0}, {0, 1}}}, 0); }), "no thickness"));
    CHECK(mentions(message([] { make_field_shape(make_half_space({0, 0, 1}, 0)); }), "no bounds"));
    CHECK(mentions(message([] { make_field_shape(make_empty()); }), "empty"));
}

}  // namespace element_shape_test
