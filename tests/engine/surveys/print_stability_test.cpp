// Stability of prints: moments in closed form, leaning prisms, mushrooms, towers pushed over.
#include "engine/surveys/print_stability.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"
#include "engine/surveys/overhang_survey.h"
#include "tests/engine/surveys/island_scenes.h"

namespace print_stability_test {

using namespace lamella;

namespace {

constexpr double spacing = 3;

StabilityLimits weight_alone(double margin = 1) {
    StabilityLimits limits;
    limits.push = limits.adhesion = limits.bond = 0;
    limits.margin = margin;
    return limits;
}

std::vector<dvec2> square(double half) {
    return {{-half, -half}, {half, -half}, {half, half}, {-half, half}};
}

/// A block on a square foot of side 10 about the origin.
PrintStability block(const StabilityLimits& limits, double volume, double center_x) {
    PrintStability print(limits, spacing);
    print.add(0, volume, dvec2(center_x, 0) * volume);
    print.lay_on_bed(0, 100, dvec2(0), square(5));
    return print;
}

/// A prism on a foot of 6 by 6 mm that leans by `slope` mm per mm in x, up to height h.
FieldPtr leaning(double slope, double h, double x = 0) {
    const FieldPtr upright = make_box({{x - 3, -3, -1}, {x + 3, 3, h}});
    const glm::dmat3 shear(dvec3(1, 0, 0), dvec3(0, 1, 0), dvec3(slope, 0, 1));
    return make_intersection(
        {make_transform(upright, shear, dvec3(0)), make_box({{-10, -10, 0}, {100, 10, h}})});
}

OverhangSurvey surveyed(const FieldPtr& part, const Box& bounds, const StabilityLimits& limits,
                        const OverhangSurveyOptions& plain = {}) {
    OverhangSurveyOptions options = plain;
    options.stability = limits;
    options.threads = 2;
    return survey_overhangs(scenes::job_of(part, bounds, 0.2), options);
}

std::size_t steadying(const OverhangSurvey& survey) {
    return static_cast<std::size_t>(
        std::count_if(survey.points.begin(), survey.points.end(),
                      [](const SupportPoint& p) { return p.reason == SupportReason::stability; }));
}

}  // namespace

TEST_CASE("weight alone stands while its centre lies inside the foot by the margin") {
    for (const double x : {0.0, 2.0, 3.99, -3.99}) {
        PrintStability print = block(weight_alone(), 1000, x);
        REQUIRE(print.steady(20).empty());
        REQUIRE(print.topples_at() == infinity);
    }
    for (const double x : {4.01, 5.5, -4.01}) {
        PrintStability print = block(weight_alone(), 1000, x);
        REQUIRE(print.steady(20).empty());
        REQUIRE(print.topples_at() == 20);
    }
}

TEST_CASE("a push topples at the height where it outdoes weight and adhesion") {
    StabilityLimits limits;
    limits.margin = 0;
    // 1000 mm^3 of 1.24 g/cm^3 weigh 0.01216 N; the foot sticks with 2 N; both act at 5 mm.
    const double most = (1000 * 1.24e-6 * 9.80665 + 100 * 0.02) * 5 / 0.1;
    PrintStability print = block(limits, 1000, 0);
    print.steady(most - 0.01);
    REQUIRE(print.topples_at() == infinity);
    print.steady(most + 0.01);
    REQUIRE(print.topples_at() == Approx(most + 0.01));
}

TEST_CASE("a point on the falling side steadies; one in the middle does not") {
    for (const double x : {5.2, 9.0}) {
        PrintStability print = block(weight_alone(), 1000, 6);
        print.offer(0, {x, 0, 3});
        const std::vector<dvec3> added = print.steady(20);
        if (x > 7) {
            REQUIRE(added == std::vector<dvec3>{{9.0, 0, 3}});
            REQUIRE(print.topples_at() == infinity);
        } else {
            REQUIRE(print.topples_at() == 20);
        }
        REQUIRE(print.steady(21).empty());
    }
}

TEST_CASE("support points hold by their bond about the far edge, from the lowest of them up") {
    StabilityLimits limits;
    limits.margin = 0;
    limits.density = 0;
    PrintStability print(limits, spacing);
    print.add(4, 1, dvec2(0));
    const double side = 6;
    for (const dvec2 p : {dvec2(-3, -3), dvec2(3, -3), dvec2(3, 3), dvec2(-3, 3)}) print.hold(4, {p, 10});
    // Each point is a disc (an octagon of its area), so the hull reaches beyond the square by its inradius.
    const double radius = std::sqrt(0.3 / (2 * std::sqrt(2.0)));
    const double moment = 4 * 0.3 * (side / 2 + radius);
    print.steady(10 + moment / 0.1 - 0.5);
    REQUIRE(print.topples_at() == infinity);
    print.steady(10 + moment / 0.1 + 0.5);
    REQUIRE(print.topples_at() < infinity);
}

TEST_CASE("what stands on its own falls no more once it is joined, and what is not joined is forgotten") {
    PrintStability print = block(weight_alone(), 1000, 0);
    print.add(1, 10, dvec2(20, 0) * 10.0);
    print.hold(1, {20, 0, 2});
    print.add(2, 10, dvec2(20, 0) * 10.0);
    print.keep_only({0, 1});
    print.join(0, 1);
    print.keep_only({0});
    // Centre of mass at 20 * 10 / 1010.
    REQUIRE(print.steady(10).empty());
    REQUIRE(print.topples_at() == infinity);
}

TEST_CASE("nothing that holds is a fall, unless a place to hold is offered") {
    PrintStability fallen(weight_alone(0), spacing);
    fallen.add(0, 10, dvec2(0));
    REQUIRE(fallen.steady(1).empty());
    REQUIRE(fallen.topples_at() == 1);
    PrintStability held(weight_alone(0), spacing);
    held.add(0, 10, dvec2(0));
    held.offer(0, {0, 0, 0.5});
    REQUIRE(held.steady(1).size() == 1);
    REQUIRE(held.topples_at() == infinity);
}

TEST_CASE("an upright cube needs no point") {
    const OverhangSurvey survey =
        surveyed(make_box({{0, 0, 0}, {10, 10, 10}}), {{0, 0, 0}, {10, 10, 10}}, StabilityLimits{});
    REQUIRE(survey.points.empty());
    REQUIRE_FALSE(survey.topples_at);
}

TEST_CASE("a leaning prism is held on its falling side from the height where its centre leaves the foot") {
    // Half the height times the slope leaves the foot's 3 mm less the margin of 1 mm.
    constexpr double slope = 0.6, h = 20;
    const double critical = 2 * 2 / slope;
    const Box bounds{{-10, -10, 0}, {20, 10, h}};
    const OverhangSurvey low =
        surveyed(leaning(slope, critical - 0.6), {bounds.lo, {20, 10, critical - 0.6}}, weight_alone());
    REQUIRE(low.points.empty());
    REQUIRE_FALSE(low.topples_at);
    const OverhangSurvey survey = surveyed(leaning(slope, h), bounds, weight_alone());
    REQUIRE_FALSE(survey.topples_at);
    REQUIRE(steadying(survey) == survey.points.size());
    REQUIRE(steadying(survey) >= 1);
    REQUIRE(steadying(survey) < 12);
    for (const SupportPoint& p : survey.points) {
        REQUIRE(p.at.x > 3);
        // On the side that faces down, where the layer above stands out.
        REQUIRE(p.at.x == Approx(3 + slope * p.at.z).margin(0.6));
    }
    REQUIRE(survey.points.front().at.z == Approx(critical).margin(0.8));
}

TEST_CASE("two prisms that lean on each other stand, if each stands until they meet") {
    // They meet at a height of 10; each alone would stand up to 13 and 7.
    constexpr double h = 20;
    for (const double slope : {0.3, 0.57}) {
        const double apart = 6 + 2 * slope * 10;
        const FieldPtr pair = make_union({leaning(slope, h), leaning(-slope, h, apart)});
        const OverhangSurvey survey = surveyed(pair, {{-10, -10, 0}, {30, 10, h}}, weight_alone());
        INFO("slope " << slope);
        REQUIRE_FALSE(survey.topples_at);
        REQUIRE(survey.points.empty() == (slope < 0.5));
        for (const SupportPoint& p : survey.points) REQUIRE(p.at.z < 10);
    }
}

TEST_CASE("a mushroom on a thin stem is steadied under its cap") {
    const FieldPtr mushroom = make_union(
        {make_cylinder({0, 0, 0}, {0, 0, 12}, 1.5), make_round_cone({{0, 0, 14}, 3, {0, 0, 24}, 12})});
    const Box bounds{{-13, -13, 0}, {13, 13, 37}};
    OverhangSurveyOptions lenient;
    lenient.limits.overhang = 2;  // nothing hangs, but it topples
    StabilityLimits limits;
    limits.push = 0.015;
    limits.margin = limits.bond = 0;
    const OverhangSurvey survey = surveyed(mushroom, bounds, limits, lenient);
    REQUIRE(steadying(survey) >= 3);
    REQUIRE_FALSE(survey.topples_at);
    dvec2 lo(infinity), hi(-infinity);
    for (const SupportPoint& p : survey.points) {
        REQUIRE(p.at.z > 10);
        lo = glm::min(lo, dvec2(p.at));
        hi = glm::max(hi, dvec2(p.at));
    }
    REQUIRE((lo.x < -1.5 && lo.y < -1.5 && hi.x > 1.5 && hi.y > 1.5));

    lenient.blocked = make_box({{-20, -20, 10}, {20, 20, 40}});
    const OverhangSurvey blocked = surveyed(mushroom, bounds, limits, lenient);
    REQUIRE(blocked.points.empty());
    REQUIRE(blocked.topples_at);
    REQUIRE(*blocked.topples_at > 12);
}

TEST_CASE("a thin tower without a face to hold says where it topples") {
    const FieldPtr tower = make_box({{0, 0, 0}, {4, 4, 30}});
    const Box bounds{{0, 0, 0}, {4, 4, 30}};
    StabilityLimits limits;
    limits.density = 0;
    const OverhangSurvey survey = surveyed(tower, bounds, limits);
    REQUIRE(survey.points.empty());
    REQUIRE(survey.topples_at);
    // The foot sticks with 0.32 N at 2 mm.
    REQUIRE(*survey.topples_at == Approx(6.4).margin(0.4));
    // What is lower than the least height is not judged.
    limits.min_height = 8;
    REQUIRE(*surveyed(tower, bounds, limits).topples_at == Approx(8).margin(0.21));
    limits.min_height = 30.5;
    REQUIRE_FALSE(surveyed(tower, bounds, limits).topples_at);
}

}  // namespace print_stability_test
