// Points of solids, found wherever they hide, and never where there is nothing.
#include "engine/field/solid_search.h"

#include <catch2/catch.hpp>
#include <random>

#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"

namespace solid_search_test {

using namespace lamella;

TEST_CASE("a ball a thousandth of the box wide is found wherever it is") {
    const Box box{dvec3(-50), dvec3(50)};
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(-49, 49);
    for (int i = 0; i < 40; ++i) {
        const FieldPtr ball = make_sphere({place(random), place(random), place(random)}, 0.05);
        const auto found = find_solid_point(*ball, box);
        REQUIRE(found);
        CHECK(ball->value(*found) < 0);
    }
}

TEST_CASE("nothing is found in what is empty or lies elsewhere") {
    const Box box{dvec3(-5), dvec3(5)};
    CHECK(!find_solid_point(*make_empty(), box));
    CHECK(!find_solid_point(*make_sphere({9, 0, 0}, 3), box));
    const FieldPtr cube = make_box(box);
    CHECK(!find_solid_point(*make_difference(cube, cube), box));
    CHECK(!find_solid_point(*cube, Box{}));
}

TEST_CASE("a thin shell that is left over is found") {
    const FieldPtr cube = make_box({dvec3(-5), dvec3(5)});
    const FieldPtr shell = make_difference(cube, make_box({dvec3(-4.99), dvec3(4.99)}));
    const auto found = find_solid_point(*shell, {dvec3(-5), dvec3(5)});
    REQUIRE(found);
    CHECK(shell->value(*found) < 0);
}

}  // namespace solid_search_test
