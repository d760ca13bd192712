// Numbers that change inside a region: exact on both sides, smooth between, enclosed by their ranges.
#include "procedural/grading/region_grading.h"

#include <catch2/catch.hpp>
#include <random>

#include "engine/base/error.h"
#include "engine/solids/primitives.h"
#include "tests/engine/field/gradings.h"

namespace region_grading_test {

using namespace lamella;

namespace {

const FieldPtr ball = make_sphere({1, 0, 0}, 4);

}  // namespace

TEST_CASE("the weight is a smoothstep centred at the border") {
    CHECK(region_weight(-1, 2) == 1);
    CHECK(region_weight(1, 2) == 0);
    CHECK(region_weight(0, 2) == 0.5);
    CHECK(region_weight(-0.5, 2) == Approx(0.84375));  // 3 t^2 - 2 t^3 at t = 3/4
    CHECK(region_weight(0.5, 2) == Approx(0.15625));
    CHECK(region_weight(-1e-12, 0) == 1);
    CHECK(region_weight(0, 0) == 0);
    CHECK(region_weight(std::nan(""), 2) == 0);
    CHECK(region_weight(std::nan(""), 0) == 0);
    CHECK(region_weight(-infinity, 2) == 1);
    CHECK(region_weight(infinity, 2) == 0);
}

TEST_CASE("deep inside and far outside the numbers are those asked for, to the last bit") {
    const auto outside = std::make_shared<Linear>(2.1, dvec3(0.03, 0.01, 0));
    const auto inside = std::make_shared<Linear>(0.7, dvec3(0, 0.02, 0.01));
    const GradingPtr both = make_region_grading(outside, inside, ball, 1.5);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(-8, 8);
    int deep = 0, far = 0, between = 0;
    for (int i = 0; i < 20000; ++i) {
        const dvec3 p(place(random), place(random), place(random));
        const double value = ball->value(p), number = both->at(p), a = outside->at(p), b = inside->at(p);
        if (value <= -0.75) {
            ++deep;
            REQUIRE(number == b);
        } else if (value >= 0.75) {
            ++far;
            REQUIRE(number == a);
        } else {
            ++between;
            REQUIRE(number <= std::max(a, b));
            REQUIRE(number >= std::min(a, b));
        }
    }
    CHECK(std::min(std::min(deep, far), between) > 100);
}

TEST_CASE(
    "across the border numbers are monotone and never steeper than 1.5 times their difference a width") {
    constexpr double width = 1.5;
    const GradingPtr both =
        make_region_grading(make_constant_grading(3), make_constant_grading(1), ball, width);
    constexpr double step = 1e-3;
    double before = both->at({1, 0, 0});
    CHECK(before == 1);
    for (double x = 1 + step; x < 9; x += step) {
        const double number = both->at({x, 0, 0});
        REQUIRE(number >= before);
        REQUIRE(number - before <= 2 * 1.5 / width * step * 1.0001);
        before = number;
    }
    CHECK(before == 3);
}

TEST_CASE("ranges enclose the numbers, are exact away from the border and tighten with the box") {
    const auto outside = std::make_shared<Linear>(2.1, dvec3(0.03, 0.01, 0));
    for (const double width : {0.0, 0.4, 3.0}) {
        const GradingPtr both = make_region_grading(outside, make_constant_grading(0.6), ball, width);
        std::mt19937 random(9);
        std::uniform_real_distribution<double> place(-7, 7), side(0.01, 2);
        for (int i = 0; i < 400; ++i) {
            const dvec3 lo(place(random), place(random), place(random));
            const Box box{lo, lo + dvec3(side(random), side(random), side(random))};
            const Interval range = both->range(box);
            for (int k = 0; k < 60; ++k) {
                std::uniform_real_distribution<double> share(0, 1);
                const dvec3 p = box.lo + box.size() * dvec3(share(random), share(random), share(random));
                REQUIRE(range.contains(both->at(p)));
            }
        }
        CHECK(both->range({dvec3(0.5), dvec3(1)}).width() == 0);
        if (width > 0) {
            // At the border, a box of side s: the number changes by at most 1.5 / width * the diagonal * the
            // difference, and the ranges of values are as wide as their box.
            const Box small{dvec3(5, 0, 0), dvec3(5.01, 0.01, 0.01)};
            CHECK(both->range(small).width() < 2 * 1.5 / width * 0.0174 * 1.7 + 0.001);
        }
    }
}

TEST_CASE("a number that is undefined on one side does not spread to the other") {
    const GradingPtr inside =
        make_region_grading(std::make_shared<Undefined>(), make_constant_grading(2), ball, 1);
    CHECK(inside->at({1, 0, 0}) == 2);
    CHECK(inside->range({dvec3(0.5), dvec3(1.5)}).hi == 2);
    CHECK(std::isnan(inside->at({9, 0, 0})));
    CHECK(inside->range({dvec3(-9), dvec3(9)}).hi == infinity);
    const GradingPtr outside =
        make_region_grading(make_constant_grading(2), std::make_shared<Undefined>(), ball, 1);
    CHECK(outside->at({9, 0, 0}) == 2);
    CHECK(std::isnan(outside->at({1, 0, 0})));
}

TEST_CASE("a region needs its numbers, its field and a width") {
    const GradingPtr one = make_constant_grading(1);
    CHECK_THROWS_AS(make_region_grading(nullptr, one, ball, 1), InputError);
    CHECK_THROWS_AS(make_region_grading(one, one, nullptr, 1), InputError);
    for (const double width : {-1.0, infinity, std::nan("")}) {
        CHECK_THROWS_AS(make_region_grading(one, one, ball, width), InputError);
    }
}

}  // namespace region_grading_test
