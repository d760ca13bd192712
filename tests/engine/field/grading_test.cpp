// Gradings as numbers and as enclosures.
#include "engine/field/grading.h"

#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "engine/formula/formula_grading.h"
#include "engine/formula/formula_parser.h"
#include "engine/solids/primitives.h"
#include "tests/engine/field/gradings.h"
#include "tests/procedural/grading/grading_checks.h"

namespace grading_test {

using namespace lamella;

namespace {

/// A wave along x whose enclosure is honest but poor: the slope's bound from the centre.
class Wave : public Grading {
  public:
    double at(dvec3 p) const override { return p.z > 9.5 ? std::nan("") : 2 + std::sin(p.x); }
    Interval range(const Box& box) const override {
        const double reach = box.size().x / 2, middle = 2 + std::sin(box.center().x);
        return {middle - reach, box.hi.z > 9.5 ? infinity : middle + reach};
    }
};

}  // namespace

TEST_CASE("a constant is the same everywhere") {
    const GradingPtr two = make_constant_grading(2);
    CHECK(two->at({1, 2, 3}) == 2);
    CHECK(two->range({{0, 0, 0}, {9, 9, 9}}).lo == 2);
    CHECK(two->range({{0, 0, 0}, {9, 9, 9}}).hi == 2);
}

TEST_CASE("depth is positive inside and its range encloses it") {
    const GradingPtr depth = make_depth_grading(make_sphere(dvec3(0), 10));
    CHECK(depth->at(dvec3(0)) == 10);
    CHECK(depth->at({12, 0, 0}) == -2);
    const Interval r = depth->range({{-1, -1, -1}, {3, 1, 1}});
    CHECK(r.lo <= 10 - std::sqrt(11.0));
    CHECK(r.hi >= 10);
}

TEST_CASE("clamping keeps numbers and ranges within limits, and NaN at the upper one") {
    const GradingPtr clamped = make_clamped_grading(std::make_shared<Wave>(), {1.5, 2.5});
    CHECK(clamped->at({1.5707963, 0, 0}) == 2.5);
    CHECK(clamped->at({-1.5707963, 0, 0}) == 1.5);
    CHECK(clamped->at({0, 0, 0}) == 2);
    CHECK(clamped->at({0, 0, 9.8}) == 2.5);
    const Interval r = clamped->range({{-50, 0, 0}, {50, 1, 10}});
    CHECK(r.lo == 1.5);
    CHECK(r.hi == 2.5);
    CHECK_THROWS_AS(make_clamped_grading(make_constant_grading(1), {2, 1}), InputError);
}

TEST_CASE("numbers asked for together are those asked for one by one", "[grading]") {
    const auto wave = std::make_shared<Wave>();
    const auto linear = std::make_shared<Linear>(0.5, dvec3(0.1, 0.2, -0.3));
    const std::vector<std::string> names{"x", "y", "z", "a", "b"};
    const Box box{dvec3(-10), dvec3(10)};
    for (const GradingPtr& grading :
         {make_clamped_grading(wave, {1.5, 2.5}), make_depth_grading(make_sphere(dvec3(0), 10)),
          make_formula_grading(parse_formula("x * b + sin(a) - z", names), {wave, linear}),
          make_formula_grading(parse_formula("b + b * y", names), {wave, linear}),
          make_formula_grading(parse_formula("x + y * z", names), {})}) {
        std::mt19937 random(1);
        std::vector<dvec3> points;
        for (int i = 0; i < 300; ++i) points.push_back(checks::random_point(random, box));
        checks::check_numbers(*grading, points);
        checks::check_numbers(*grading, {});
    }
}

TEST_CASE("a tight range encloses the numbers and exceeds them little") {
    const Interval r = tight_range(Wave(), {{-50, 0, 0}, {50, 1, 1}});
    CHECK(r.lo <= 1);
    CHECK(r.lo > 0.95);
    CHECK(r.hi >= 3);
    CHECK(r.hi < 3.05);
    const Interval flat = tight_range(*make_constant_grading(4), {{0, 0, 0}, {1, 1, 1}});
    CHECK(flat.lo == 4);
    CHECK(flat.hi == 4);
}

TEST_CASE("a survey counts what lies outside the limits, in the body alone") {
    const FieldPtr body = make_box({{-10, -10, -10}, {10, 10, 10}});
    const GradingSurvey survey = survey_grading(Wave(), *body, {1.5, 2.5}, 40);
    CHECK(survey.points == 40 * 40 * 40);
    CHECK(survey.undefined == 40 * 40);
    int below = 0, above = 0;
    for (int i = 0; i < 40; ++i) {
        const double number = 2 + std::sin(-9.75 + 0.5 * i);
        below += number < 1.5;
        above += number > 2.5;
    }
    CHECK(survey.below == below * 40 * 39);
    CHECK(survey.above == above * 40 * 39);
    CHECK(survey.asked.lo >= 1);
    CHECK(survey.asked.hi <= 3);
}

TEST_CASE("a length that is not one everywhere is refused by name", "[grading]") {
    const Box box{dvec3(0), dvec3(1)};
    CHECK(positive_range(*make_constant_grading(3), box, "the width").hi == 3);
    CHECK_THROWS_WITH(positive_range(*make_constant_grading(0), box, "the width"),
                      Catch::StartsWith("the width is 0 mm"));
    CHECK_THROWS_AS(positive_range(*make_constant_grading(infinity), box, "the width"), InputError);
    CHECK_THROWS_AS(positive_range(Undefined(), box, "the width"), InputError);
    CHECK_THROWS_AS(positive_range(Linear(0.5, dvec3(-1, 0, 0)), box, "the width"), InputError);
}

}  // namespace grading_test
