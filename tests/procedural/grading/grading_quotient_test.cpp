// Quotients of gradings and the check that a length is positive and finite.
#include "procedural/grading/grading_quotient.h"

#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "tests/engine/field/gradings.h"
#include "tests/procedural/grading/grading_checks.h"

namespace grading_quotient_test {

using namespace lamella;

TEST_CASE("a quotient's range encloses its numbers", "[grading_quotient]") {
    const auto n = std::make_shared<Linear>(0.5, dvec3(1, 0, 0));
    const auto d = std::make_shared<Linear>(2, dvec3(0.5, 0.25, 0));
    const GradingPtr quotient = make_quotient_grading(n, d);
    CHECK(quotient->at({1, 0, 0}) == 0.6);
    for (const double x : {-2.0, 0.0, 1.5}) {
        const Box box{{x, -1, 0}, {x + 1, 1, 1}};
        const Interval range = quotient->range(box);
        std::mt19937 random(3);
        checks::excess(*quotient, box, random, 100);
        for (int i = 0; i <= 100; ++i) {
            const double t = i / 100.0;
            CHECK(range.contains(quotient->at({x + t, 2 * t - 1, 0})));
            CHECK(range.contains(quotient->at({x + t, 1 - 2 * t, 0})));
        }
    }
    CHECK(quotient->range({{-5, 0, 0}, {-3, 1, 1}}).lo == -infinity);
    // Proportional numbers: tight_range sees through what intervals do not.
    const GradingPtr half = make_quotient_grading(std::make_shared<Linear>(1, dvec3(1, 0, 0)),
                                                  std::make_shared<Linear>(2, dvec3(2, 0, 0)));
    CHECK(half->range({dvec3(0), dvec3(9)}).hi == 5);
    CHECK(tight_range(*half, {dvec3(0), dvec3(9)}).hi < 0.51);
}

}  // namespace grading_quotient_test
