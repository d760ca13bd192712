// Checks over layers of several heights: they find what they find in fine equal layers, with its size.
#include <catch2/catch.hpp>
#include <cmath>

#include "engine/checks/print_check.h"
#include "engine/layers/layer_stream.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"
#include "engine/surveys/island_survey.h"

namespace varied_layers_test {

using namespace lamella;

namespace {

constexpr double pi = 3.14159265358979;

/// 12 mm in layers of 0.3 mm, then of 0.1, 0.2 and 0.4 mm.
const LayerPlan varied({{10, 0.3}, {30, 0.1}, {10, 0.2}, {10, 0.4}});

Job job_of(FieldPtr part, const LayerPlan& layers = varied) {
    Job job;
    job.bounds = {{-10, -10, 0}, {10, 10, 12}};
    job.part = std::move(part);
    job.layers = layers;
    return job;
}

CheckResult result_of(const Job& job, Check check, const PrintLimits& limits = {}) {
    PrintCheckOptions options;
    options.limits = limits;
    options.limits.verdicts.fill(Severity::off);
    options.limits.verdicts[static_cast<std::size_t>(check)] = Severity::fail;
    options.pitch = 0.08;
    PrintCheck checks(job, options);
    survey_layers(job, checks, {});
    return checks.report().results.front();
}

FieldPtr box(dvec3 lo, dvec3 hi) { return make_box({lo, hi}); }

}  // namespace

TEST_CASE("pieces, voids and gaps have their volumes and layers", "[check][layers]") {
    const FieldPtr post = box({-8, -8, 0}, {8, 8, 12});
    SECTION("a piece beside the part") {
        const FieldPtr part = make_union({box({-8, -8, 0}, {0, 8, 12}), box({4, 4, 2.1}, {6, 6, 5.2})});
        const CheckResult found = result_of(job_of(part), Check::connectivity);
        REQUIRE(found.count == 1);
        CHECK(found.worst.front().size == Approx(4 * 3.1).epsilon(0.02));
        CHECK(found.worst.front().first_layer == 7);
        CHECK(found.worst.front().end_layer == 10 + 22);
        CHECK(found.worst.front().box.lo.z == Approx(2.1));
        CHECK(found.worst.front().box.hi.z == Approx(5.2));
    }
    SECTION("a cavity") {
        const FieldPtr part = make_difference(post, box({-2, -2, 5}, {2, 2, 7.6}));
        const CheckResult found = result_of(job_of(part), Check::cavities);
        REQUIRE(found.count == 1);
        CHECK(found.worst.front().size == Approx(16 * 2.6).epsilon(0.02));
    }
    SECTION("empty layers") {
        const FieldPtr part = make_union({box({-8, -8, 0}, {8, 8, 3.6}), box({-8, -8, 6.4}, {8, 8, 12})});
        const CheckResult found = result_of(job_of(part), Check::empty_layers);
        REQUIRE(found.count == 1);
        CHECK(found.worst.front().size == Approx(2.8));
        CHECK(found.worst.front().first_layer == 16);
    }
    SECTION("the machine's height") {
        PrintLimits limits;
        limits.build_volume = {100, 100, 11};
        const CheckResult found = result_of(job_of(post), Check::build_volume, limits);
        REQUIRE(found.count == 1);
        CHECK(found.worst.front().size == Approx(1));
    }
    SECTION("the whole") {
        PrintCheckOptions options;
        options.limits.verdicts.fill(Severity::off);
        options.limits.verdicts[0] = Severity::fail;
        options.pitch = 0.08;
        const Job job = job_of(post);
        PrintCheck checks(job, options);
        survey_layers(job, checks, {});
        CHECK(checks.report().volume == Approx(16 * 16 * 12).epsilon(0.01));
    }
}

TEST_CASE("slopes that grow with a layer's height are held to its height", "[check][layers]") {
    // A block with a side that leans outward, by this many degrees from upright.
    const auto wedge = [](double degrees) {
        const double a = degrees * pi / 180;
        return make_intersection(
            {make_half_space({std::cos(a), 0, -std::sin(a)}, 0), box({-8, -8, 0}, {40, 8, 12})});
    };
    PrintLimits limits;
    limits.overhang = 0.1;  // of the least layer: 45 degrees
    limits.overhang_grows = true;
    const auto faults = [&](double degrees, const LayerPlan& layers) {
        Job job = job_of(wedge(degrees), layers);
        job.bounds = job.part->bounds();
        job.bounds.lo.z = 0;
        job.bounds.hi.z = 12;
        return result_of(job, Check::overhangs, limits).count;
    };
    CHECK(faults(35, varied) == 0);
    CHECK(faults(65, varied) > 0);
    CHECK(faults(35, LayerPlan(120, 0.1)) == 0);
    CHECK(faults(65, LayerPlan(120, 0.1)) > 0);
    limits.overhang_grows = false;  // of every layer, so high ones lean less
    CHECK(faults(35, varied) > 0);
    CHECK(faults(35, LayerPlan(120, 0.1)) == 0);
}

TEST_CASE("thin plates are found at any height of layers", "[check][layers]") {
    const double at = GENERATE(1.5, 4.5, 7.0, 10.0);
    INFO("at " << at << " mm");
    const auto with_plate = [&](double thickness) {
        return make_union({box({-8, -8, 0}, {-4, 8, 12}), box({-8, -8, at}, {8, 8, at + thickness})});
    };
    PrintLimits limits;
    limits.thickness = 1.2;
    limits.thickness_up = 1.2;
    const CheckResult thin = result_of(job_of(with_plate(0.6)), Check::thickness, limits);
    REQUIRE(thin.count > 0);
    CHECK(std::abs(thin.worst.front().at.z - at - 0.3) < 0.5);
    CHECK(varied.bottom(thin.worst.front().first_layer) < at + 0.6);
    CHECK(varied.top(thin.worst.front().end_layer - 1) > at);
    CHECK(result_of(job_of(with_plate(2)), Check::thickness, limits).count == 0);
}

TEST_CASE("necks are found at any height of layers", "[check][layers]") {
    const double at = GENERATE(4.0, 6.0, 8.0);
    INFO("at " << at << " mm");
    const auto with_neck = [&](double radius) {
        return make_union({box({-8, -8, 0}, {8, 8, at - 1.5}), box({-8, -8, at + 1.5}, {8, 8, 12}),
                           make_cylinder({0, 0, at - 2}, {0, 0, at + 2}, radius)});
    };
    PrintLimits limits;
    limits.neck = 1.5;
    limits.large_part = 100;
    CHECK(result_of(job_of(with_neck(0.4), LayerPlan(120, 0.1)), Check::necks, limits).count == 1);
    const CheckResult found = result_of(job_of(with_neck(0.4)), Check::necks, limits);
    REQUIRE(found.count == 1);
    CHECK(std::abs(found.worst.front().at.z - at) < 1.5);
    CHECK(result_of(job_of(with_neck(1.5)), Check::necks, limits).count == 0);
}

TEST_CASE("islands are dropped whole between layers of several heights", "[survey][layers]") {
    const FieldPtr body = box({-8, -8, 0}, {8, 8, 12});
    const FieldPtr part = make_union({box({-8, -8, 0}, {0, 8, 12}), make_sphere({4, 4, 5.03}, 1.5)});
    IslandSurveyOptions options;
    options.pitch = 0.1;
    const IslandSurvey survey = survey_islands(job_of(part), body, options);
    REQUIRE(survey.report.count == 1);
    const Island& island = survey.report.largest.front();
    CHECK(island.volume == Approx(4.0 / 3 * pi * 1.5 * 1.5 * 1.5).epsilon(0.02));
    CHECK(island.first_layer == varied.layer_at(5.03 - 1.5 + 0.05));
    CHECK(island.end_layer == varied.layer_at(5.03 + 1.5 - 0.05) + 1);
}

}  // namespace varied_layers_test
