// Slopes of formulas at their surface against their derivatives.
#include "procedural/grading/field_slope.h"

#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "engine/formula/formula_field.h"
#include "engine/formula/formula_parser.h"

namespace field_slope_test {

using namespace lamella;

namespace {

const Box box{dvec3(-5), dvec3(5)};

FieldPtr formula(const char* text) {
    return make_formula_field(parse_formula(text, std::vector<std::string>{"x", "y", "z"}), {},
                              grown(box, 100));
}

}  // namespace

TEST_CASE("the slope at the surface is the formula's derivative there") {
    CHECK(slope_at_surface(*formula("hypot(x, y, z) - 3"), box) == Approx(1).epsilon(1e-6));
    CHECK(slope_at_surface(*formula("7*(hypot(x, y) - 3)"), box) == Approx(7).epsilon(1e-6));
    // |grad| = 2 r: 6 at r = 3, whatever it is elsewhere.
    CHECK(slope_at_surface(*formula("x*x + y*y + z*z - 9"), box) == Approx(6).epsilon(1e-6));
    // An ellipse is steepest at the end of its short axis: 1 / 2.
    CHECK(slope_at_surface(*formula("hypot(x/4, y/2) - 1"), box) == Approx(0.5).epsilon(5e-3));
    CHECK(slope_at_surface(*formula("z + 20"), box) == 1);
}

TEST_CASE("divided by its slope, a formula of a ball is its distance") {
    const FieldPtr even = make_unit_slope(formula("4*(hypot(x, y, z) - 3)"), box);
    CHECK(even->value({5, 0, 0}) == Approx(2).epsilon(1e-6));
    CHECK(even->value({0, 1, 0}) == Approx(-2).epsilon(1e-6));
    const Interval range = even->range({dvec3(1), dvec3(1.5)});
    CHECK(range.contains(even->value({1.2, 1.3, 1.4})));
}

TEST_CASE("values that jump at the surface make no distance") {
    CHECK_THROWS_WITH(slope_at_surface(*formula("x < 1 ? -1 : 1"), box), Catch::Contains("jump"));
    CHECK_NOTHROW(slope_at_surface(*formula("z - sqrt(4 - x*x - y*y)"), box));
}

}  // namespace field_slope_test
