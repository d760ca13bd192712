// The overhang survey: shapes with known critical heights, bridges, islands, ceilings.
#include "engine/surveys/overhang_survey.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"
#include "tests/engine/surveys/overhang_scenes.h"

namespace overhang_survey_test {

using namespace lamella;
using overhangs::height;
using overhangs::near_point;
using overhangs::without_stability;

namespace {

OverhangSurvey surveyed(const FieldPtr& part, const Box& bounds,
                        const OverhangSurveyOptions& options = without_stability()) {
    return survey_overhangs(scenes::job_of(part, bounds, height), options);
}

FieldPtr box(dvec3 lo, dvec3 hi) { return make_box({lo, hi}); }

double length2d(dvec3 v) { return std::sqrt(v.x * v.x + v.y * v.y); }
std::size_t count(const OverhangSurvey& survey, SupportReason reason) {
    return static_cast<std::size_t>(std::count_if(survey.points.begin(), survey.points.end(),
                                                  [&](const SupportPoint& p) { return p.reason == reason; }));
}

/// A wedge: a post with one face that leans out by `slope` mm per mm of height.
FieldPtr wedge(double slope, double length) {
    const double norm = std::sqrt(1 + slope * slope);
    const FieldPtr lean = make_half_space(dvec3(1, 0, -slope) / norm, 5 / norm);
    return make_intersection({lean, box({0, 0, 0}, {50, length, 20})});
}

}  // namespace

TEST_CASE("a ball on the bed is held below its critical height, all round, and nowhere above") {
    constexpr double radius = 10;
    const FieldPtr ball = make_sphere({0, 0, radius}, radius);
    const Box bounds{{-10, -10, 0}, {10, 10, 20}};
    const OverhangSurveyOptions options = without_stability();
    const OverhangSurvey survey = surveyed(ball, bounds, options);
    const auto outline = [&](int layer) {
        const double down = radius - (layer + 0.5) * height;
        return std::sqrt(radius * radius - down * down);
    };
    REQUIRE(survey.points.size() >= 10);
    REQUIRE(count(survey, SupportReason::overhang) == survey.points.size());
    constexpr double noise = 0.02;
    for (const SupportPoint& p : survey.points) {
        const int layer = static_cast<int>(std::lround(p.at.z / height));
        REQUIRE(p.at.z == Approx(layer * height));
        REQUIRE(outline(layer) - outline(layer - 1) > options.limits.overhang - noise);
        REQUIRE(length2d(p.at) == Approx(outline(layer) - options.limits.width / 2).margin(noise));
    }
    double hanging = 0;
    int highest = 0;
    for (int layer = 1; layer < 100; ++layer) {
        if (outline(layer) - outline(layer - 1) < options.limits.overhang + noise) continue;
        highest = layer;
        hanging += 2 * pi * outline(layer);
        for (int k = 0; k < 360; ++k) {
            const double a = pi * k / 180, r = outline(layer);
            const dvec3 p(r * std::cos(a), r * std::sin(a), layer * height);
            REQUIRE(near_point(survey, p,
                               options.limits.spacing + options.limits.free_stretch + options.limits.width));
        }
    }
    // tan of the critical angle is the overhang over the layer's height.
    const double slope = options.limits.overhang / height;
    REQUIRE(highest * height ==
            Approx(radius * (1 - slope / std::sqrt(1 + slope * slope))).margin(2 * height));
    REQUIRE(survey.hanging_length >= hanging * 0.99);
    REQUIRE(survey.hanging_length <= (hanging + 4 * pi * outline(highest)) * 1.01);
}

TEST_CASE("a wedge hangs when it leans out by more than the allowance per layer") {
    const Box bounds{{0, 0, 0}, {50, 30, 20}};
    REQUIRE(surveyed(wedge(0.84, 30), bounds).points.empty());  // 40 degrees from the vertical
    REQUIRE(surveyed(wedge(1.10, 30), bounds).points.empty());
    REQUIRE(surveyed(wedge(1.10, 30), bounds).hanging_length == 0);
    const OverhangSurvey steep = surveyed(wedge(1.73, 30), bounds);  // 60 degrees
    REQUIRE(count(steep, SupportReason::overhang) == steep.points.size());
    // 30 mm by 20 mm times two of sloping face, points between three and six millimetres apart.
    REQUIRE(steep.points.size() > 30 * 40 / (6 * 6));
    REQUIRE(steep.points.size() < 3 * 30 * 40 / (3 * 3));
    REQUIRE(steep.hanging_length == Approx(99 * 30).epsilon(0.05));
    // A face no longer than a bridge is laid from side to side.
    const OverhangSurvey narrow = surveyed(wedge(1.73, 8), bounds);
    REQUIRE(narrow.points.empty());
    REQUIRE(narrow.own_bridges == 99);
}

TEST_CASE("a bridge between two pillars is left to itself up to the limit, in whatever direction it runs") {
    for (const double turn : {0.0, 0.3, 0.785, 1.2}) {
        for (const double gap : {8.0, 14.0}) {
            const FieldPtr body =
                make_union({box({-12, -2, 0}, {-gap / 2, 2, 10}), box({gap / 2, -2, 0}, {12, 2, 10}),
                            box({-12, -2, 8}, {12, 2, 10})});
            const double c = std::cos(turn), s = std::sin(turn);
            const glm::dmat3 linear(dvec3(c, s, 0), dvec3(-s, c, 0), dvec3(0, 0, 1));
            const FieldPtr part = turn == 0 ? body : make_transform(body, linear, dvec3(0));
            const OverhangSurvey survey = surveyed(part, {{-13, -13, 0}, {13, 13, 10}});
            INFO("gap " << gap << ", turned by " << turn);
            if (gap < 10) {
                REQUIRE(survey.points.empty());
                REQUIRE(survey.own_bridges == 2);
                REQUIRE(survey.hanging_length == Approx(2 * gap).margin(1.5));
            } else {
                REQUIRE(survey.points.size() >= 4);
                REQUIRE(survey.own_bridges == 0);
                for (const SupportPoint& p : survey.points) {
                    REQUIRE(p.at.z == Approx(8));
                    REQUIRE(length2d(p.at) < gap / 2 + 1);
                }
            }
        }
    }
}

TEST_CASE("a table's plate is held along its border and inside, and nowhere over its column") {
    const FieldPtr table = make_union({box({-3, -3, 0}, {3, 3, 10}), box({-15, -15, 10}, {15, 15, 12})});
    const OverhangSurvey survey = surveyed(table, {{-15, -15, 0}, {15, 15, 12}});
    REQUIRE(survey.own_bridges == 0);
    REQUIRE(count(survey, SupportReason::overhang) >= 26);
    REQUIRE(count(survey, SupportReason::span) >= 20);
    for (const SupportPoint& p : survey.points) {
        REQUIRE(p.at.z == Approx(10));
        REQUIRE(std::max(std::abs(p.at.x), std::abs(p.at.y)) > 3.2);
    }
    for (double x = -14.7; x < 15; x += 0.3) {
        for (double y = -14.7; y < 15; y += 0.3) {
            if (std::max(std::abs(x), std::abs(y)) < 3.5) continue;
            REQUIRE(near_point(survey, {x, y, 10}, 3.5));
        }
    }
}

TEST_CASE("a T is held under both arms") {
    const FieldPtr t = make_union({box({-2, -2, 0}, {2, 2, 10}), box({-14, -2, 10}, {14, 2, 13})});
    const OverhangSurvey survey = surveyed(t, {{-14, -2, 0}, {14, 2, 13}});
    const auto under = [&](double side) {
        return std::count_if(survey.points.begin(), survey.points.end(),
                             [&](const SupportPoint& p) { return p.at.x * side > 2; });
    };
    REQUIRE(under(1) >= 4);
    REQUIRE(under(-1) >= 4);
    for (const double x : {-13.7, -8.0, 8.0, 13.7}) REQUIRE(near_point(survey, {x, 0, 10}, 4));
}

TEST_CASE("a room's ceiling is bridged when one direction is short enough, and held inside when none is") {
    const auto room = [](double x, double y) {
        return make_difference(box({-x / 2 - 3, -y / 2 - 3, 0}, {x / 2 + 3, y / 2 + 3, 12}),
                               box({-x / 2, -y / 2, 2}, {x / 2, y / 2, 10}));
    };
    const Box bounds{{-20, -20, 0}, {20, 20, 12}};
    REQUIRE(surveyed(room(8, 30), bounds).points.empty());
    REQUIRE(surveyed(room(30, 8), bounds).points.empty());
    const OverhangSurvey wide = surveyed(room(20, 20), bounds);
    REQUIRE(wide.points.size() >= 16);
    REQUIRE(count(wide, SupportReason::span) == wide.points.size());
    for (double x = -9.5; x < 10; x += 0.5) {
        for (double y = -9.5; y < 10; y += 0.5) REQUIRE(near_point(wide, {x, y, 10}, 3.5));
    }
    for (const SupportPoint& p : wide.points) REQUIRE(p.at.z == Approx(10));
}

TEST_CASE("a tunnel's vault is held from its critical height on, unless it is short enough to be bridged") {
    constexpr double radius = 7.05, limit = 0.225;
    const auto tunnel = [](double length) {
        return make_difference(box({-12, 0, 0}, {12, length, 12}),
                               make_cylinder({0, -1, 0}, {0, length + 1, 0}, radius));
    };
    const Box bounds{{-12, 0, 0}, {12, 30, 12}};
    const OverhangSurvey survey = surveyed(tunnel(30), bounds);
    const auto side = [&](int layer) {
        const double z = (layer + 0.5) * height;
        return z < radius ? std::sqrt(radius * radius - z * z) : 0.0;
    };
    const auto step_in = [&](const SupportPoint& p) {
        const int layer = static_cast<int>(std::lround(p.at.z / height));
        return side(layer - 1) - side(layer);
    };
    // An outline that turns a corner in the air is no straight run, however short it is.
    const OverhangSurvey shortened = surveyed(tunnel(8), bounds);
    for (const SupportPoint& p : shortened.points) REQUIRE(step_in(p) > limit + 0.45 / 2 - 0.02);
    REQUIRE(shortened.own_bridges > 4);
    REQUIRE(survey.points.size() >= 14);
    for (const SupportPoint& p : survey.points) REQUIRE(step_in(p) > limit - 0.02);
    for (int layer = 1; side(layer - 1) > 0; ++layer) {
        if (side(layer - 1) - side(layer) < limit + 0.02) continue;
        for (double y = 0.5; y < 30; y += 0.5) {
            REQUIRE(near_point(survey, {side(layer), y, layer * height}, 4.3));
            REQUIRE(near_point(survey, {-side(layer), y, layer * height}, 4.3));
        }
    }
}

TEST_CASE("a closed cavity is held under its vault, from inside") {
    const FieldPtr part = make_difference(box({-12, -12, 0}, {12, 12, 24}), make_sphere({0, 0, 12}, 9));
    const OverhangSurvey survey = surveyed(part, {{-12, -12, 0}, {12, 12, 24}});
    REQUIRE(survey.points.size() >= 8);
    const double critical = 12 + 9 * (0.225 / height) / std::sqrt(1 + 0.225 * 0.225 / (height * height));
    for (const SupportPoint& p : survey.points) REQUIRE(p.at.z > critical - 2 * height);
    REQUIRE(near_point(survey, {0, 0, 20.8}, 4.3));
}

TEST_CASE("the lowest tip of what begins in the air has a point, however small it is") {
    const FieldPtr part = make_union({box({-2, -2, 0}, {2, 2, 12}), box({-2, -2, 10}, {12, 2, 12}),
                                      make_cylinder({10, 0, 6}, {10, 0, 11}, 0.3)});
    const OverhangSurvey survey = surveyed(part, {{-2, -2, 0}, {12, 2, 12}});
    REQUIRE(count(survey, SupportReason::island) == 1);
    const SupportPoint& tip = survey.points.front();
    REQUIRE(tip.reason == SupportReason::island);
    REQUIRE(tip.at.z == Approx(6));
    REQUIRE(length2d(tip.at - dvec3(10, 0, 0)) < 0.15);
    // A ball in the air: its tip first, then rings.
    const OverhangSurvey ball = surveyed(make_sphere({0, 0, 10}, 5), {{-5, -5, 0}, {5, 5, 15}});
    REQUIRE(ball.points.front().at.z == Approx(5).margin(height));
    REQUIRE(ball.points.front().reason == SupportReason::island);
    REQUIRE(ball.points.size() >= 5);
    // A plate in the air is an island as a whole.
    const OverhangSurvey plate = surveyed(box({-8, -8, 5}, {8, 8, 6}), {{-8, -8, 0}, {8, 8, 6}});
    REQUIRE(count(plate, SupportReason::island) >= 64 / 4 - 2);
    for (const SupportPoint& p : plate.points) REQUIRE(p.at.z == Approx(5));
}

TEST_CASE("a wall thinner than a bead is held along its middle") {
    const FieldPtr wall = make_union({box({-1, -0.1, 0}, {1, 0.1, 12}), box({-15, -0.1, 8}, {15, 0.1, 12})});
    const OverhangSurvey survey = surveyed(wall, {{-15, -0.2, 0}, {15, 0.2, 12}});
    REQUIRE(survey.points.size() >= 6);
    for (const SupportPoint& p : survey.points) {
        REQUIRE(p.at.z == Approx(8));
        REQUIRE(std::abs(p.at.y) < 0.03);
    }
    for (double x = 2; x < 15; x += 0.25) REQUIRE(near_point(survey, {x, 0, 8}, 4.2));
}

TEST_CASE("a stretch no longer than the free one may hang") {
    const auto ledge = [](double out) {
        return make_union({box({0, 0, 0}, {10, 10, 10}), box({9, 4.8, 6}, {10 + out, 5.2, 10})});
    };
    const Box bounds{{0, 0, 0}, {14, 10, 10}};
    REQUIRE(surveyed(ledge(0.3), bounds).points.empty());
    REQUIRE_FALSE(surveyed(ledge(3), bounds).points.empty());
    OverhangSurveyOptions generous = without_stability();
    generous.limits.free_stretch = 10;
    generous.limits.spacing = 12;
    REQUIRE(surveyed(ledge(3), bounds, generous).points.empty());
}

TEST_CASE("what is enforced is held where it stands out at all; what is blocked has no point") {
    const FieldPtr part = wedge(0.5, 8);
    const Box bounds{{0, 0, 0}, {50, 8, 20}};
    OverhangSurveyOptions options = without_stability();
    REQUIRE(surveyed(part, bounds, options).points.empty());
    options.enforced = box({-1, -1, 5}, {51, 9, 12});
    const OverhangSurvey enforced = surveyed(part, bounds, options);
    REQUIRE(enforced.points.size() >= 4);
    REQUIRE(enforced.own_bridges == 0);
    for (const SupportPoint& p : enforced.points) {
        REQUIRE(p.at.z >= 5 - 1e-9);
        REQUIRE(p.at.z <= 12);
    }

    const FieldPtr table = make_union({box({-3, -3, 0}, {3, 3, 10}), box({-15, -15, 10}, {15, 15, 12})});
    const Box table_bounds{{-15, -15, 0}, {15, 15, 12}};
    const OverhangSurveyOptions plain = without_stability();
    const OverhangSurvey all = surveyed(table, table_bounds, plain);
    OverhangSurveyOptions half = plain;
    half.blocked = box({0, -20, 0}, {20, 20, 20});
    const OverhangSurvey left = surveyed(table, table_bounds, half);
    REQUIRE(left.blocked > all.points.size() / 4);
    REQUIRE(left.blocked < all.points.size());
    for (const SupportPoint& p : left.points) REQUIRE(p.at.x <= 0);
    // Up to the border of what is blocked all is held.
    for (double y = -14.5; y < 15; y += 0.5) {
        if (std::abs(y) > 3.5) REQUIRE(near_point(left, {-0.3, y, 10}, 4.2));
    }
    REQUIRE(all.blocked == 0);
}

TEST_CASE("a raised part is held from its first layer on") {
    const FieldPtr part = box({0, 0, 0}, {12, 12, 4});
    const Box bounds{{0, 0, 0}, {12, 12, 4}};
    OverhangSurveyOptions options = without_stability();
    REQUIRE(surveyed(part, bounds, options).points.empty());
    options.on_bed = false;
    const OverhangSurvey raised = surveyed(part, bounds, options);
    REQUIRE(raised.points.size() >= 12);
    for (const SupportPoint& p : raised.points) REQUIRE(p.at.z == 0);
    for (double x = 0.3; x < 12; x += 0.3) {
        for (double y = 0.3; y < 12; y += 0.3) REQUIRE(near_point(raised, {x, y, 0}, 3.6));
    }
}

TEST_CASE("the points do not depend on the number of threads") {
    const FieldPtr part = make_union(
        {make_sphere({0, 0, 9}, 6), make_torus({0, 0, 6}, 9, 1.2), box({-12, -1, 14}, {12, 1, 16})});
    const Job job = scenes::job_of(part, {{-12, -12, 0}, {12, 12, 16}}, height);
    OverhangSurveyOptions options;
    options.threads = 1;
    const OverhangSurvey one = survey_overhangs(job, options);
    REQUIRE(one.points.size() > 20);
    REQUIRE(std::is_sorted(one.points.begin(), one.points.end(),
                           [](const auto& a, const auto& b) { return a.at.z < b.at.z; }));
    for (const int threads : {2, 4}) {
        options.threads = threads;
        const OverhangSurvey many = survey_overhangs(job, options);
        REQUIRE(many.points == one.points);
        REQUIRE(many.hanging_length == one.hanging_length);
        REQUIRE(many.own_bridges == one.own_bridges);
        REQUIRE(many.topples_at == one.topples_at);
    }
}

TEST_CASE("a survey of overhangs tells how far it is, and stops when asked") {
    const Job job = scenes::job_of(make_sphere({0, 0, 4}, 4), {{-4, -4, 0}, {4, 4, 8}}, height);
    OverhangSurveyOptions options;
    CancelToken cancel;
    options.cancel = &cancel;
    int calls = 0;
    options.on_progress = [&](const Progress& progress) {
        ++calls;
        REQUIRE(progress.total == 40);
        if (progress.done == 5) cancel.cancel();
    };
    REQUIRE_THROWS_AS(survey_overhangs(job, options), Interrupted);
    REQUIRE(calls >= 5);
    REQUIRE(calls < 40);
}

TEST_CASE("limits that make no sense are refused with what would") {
    const Job job = scenes::job_of(make_sphere({0, 0, 4}, 4), {{-4, -4, 0}, {4, 4, 8}}, height);
    const auto refused = [&](auto change) {
        OverhangSurveyOptions options;
        change(options);
        REQUIRE_THROWS_AS(survey_overhangs(job, options), InputError);
    };
    for (const double wrong : {0.0, -1.0, static_cast<double>(NAN), infinity}) {
        refused([&](auto& o) { o.limits.overhang = wrong; });
        refused([&](auto& o) { o.limits.width = wrong; });
        refused([&](auto& o) { o.limits.spacing = wrong; });
        refused([&](auto& o) { o.stability->contact = wrong; });
    }
    for (const double wrong : {-1.0, static_cast<double>(NAN), infinity}) {
        refused([&](auto& o) { o.limits.free_stretch = wrong; });
        refused([&](auto& o) { o.limits.bridge = wrong; });
        refused([&](auto& o) { o.stability->push = wrong; });
        refused([&](auto& o) { o.stability->margin = wrong; });
        refused([&](auto& o) { o.stability->density = wrong; });
        refused([&](auto& o) { o.stability->adhesion = wrong; });
        refused([&](auto& o) { o.stability->bond = wrong; });
        refused([&](auto& o) { o.stability->min_height = wrong; });
    }
    refused([&](auto& o) { o.limits.overhang = 1e-5; });
    Job endless = job;
    endless.bounds.hi.x = infinity;
    REQUIRE_THROWS_AS(survey_overhangs(endless, {}), InputError);
    Job bare = job;
    bare.part = nullptr;
    REQUIRE_THROWS_AS(survey_overhangs(bare, {}), InputError);
}

TEST_CASE("an empty part needs nothing") {
    const OverhangSurvey survey = surveyed(make_empty(), {dvec3(0), dvec3(1)}, OverhangSurveyOptions{});
    REQUIRE(survey.points.empty());
    REQUIRE(survey.hanging_length == 0);
    REQUIRE_FALSE(survey.topples_at);
}

}  // namespace overhang_survey_test
