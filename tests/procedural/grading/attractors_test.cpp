// Distances against every attractor in turn, and falloffs against their formulas.
#include "procedural/grading/attractors.h"

#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "tests/procedural/grading/grading_checks.h"

namespace attractors_test {

using namespace lamella;
using Kind = Attractor::Kind;

namespace {

const Box space{{-50, -40, -30}, {50, 40, 30}};

std::vector<Attractor> random_attractors(int points, int segments, int planes, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<Attractor> list;
    const auto add = [&](Kind kind, int count) {
        for (int i = 0; i < count; ++i) {
            const dvec3 a = checks::random_point(random, space), b = checks::random_point(random, space);
            list.push_back({kind, a, kind == Kind::segment ? a + (b - a) * 0.1 : b});
        }
    };
    add(Kind::point, points);
    add(Kind::segment, segments);
    add(Kind::plane, planes);
    std::shuffle(list.begin(), list.end(), random);
    return list;
}

/// The distance by a fine march along the segment: independent of projections.
double marched(const Attractor& s, dvec3 p) {
    double best = infinity;
    for (int i = 0; i <= 1000; ++i) best = std::min(best, glm::length(p - glm::mix(s.a, s.b, i / 1000.0)));
    return best;
}

double brute_distance(const std::vector<Attractor>& list, dvec3 p) {
    double best = infinity;
    for (const Attractor& attractor : list) {
        double d = glm::length(p - attractor.a);
        if (attractor.kind == Kind::segment) {
            const dvec3 e = attractor.b - attractor.a;
            const double t = glm::clamp(glm::dot(p - attractor.a, e) / glm::dot(e, e), 0.0, 1.0);
            d = glm::length(p - attractor.a - e * t);
        } else if (attractor.kind == Kind::plane) {
            d = std::abs(glm::dot(p - attractor.a, glm::normalize(attractor.b)));
        }
        best = std::min(best, d);
    }
    return best;
}

std::string message_of(std::vector<Attractor> list) {
    try {
        make_distance_grading(std::move(list));
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("distances to a point, a segment and planes have closed forms") {
    CHECK(make_distance_grading({{Kind::point, {1, 2, 3}, {}}})->at({4, 6, 3}) == 5);
    const GradingPtr segment = make_distance_grading({{Kind::segment, {0, 0, 0}, {10, 0, 0}}});
    CHECK(segment->at({5, 3, 4}) == 5);
    CHECK(segment->at({13, 4, 0}) == 5);
    CHECK(segment->at({-3, 0, 4}) == 5);
    const GradingPtr plane = make_distance_grading({{Kind::plane, {0, 0, 5}, {0, 0, 7}}});
    CHECK(plane->at({9, 9, 8}) == 3);
    CHECK(plane->at({9, 9, 1}) == -4);
    const GradingPtr two =
        make_distance_grading({{Kind::plane, {0, 0, 5}, {0, 0, 7}}, {Kind::plane, {0, 0, 0}, {0, 0, -1}}});
    CHECK(two->at({9, 9, 4}) == 1);
    CHECK(two->at({9, 9, 1}) == 1);
    CHECK(make_distance_grading({{Kind::segment, {1, 1, 1}, {1, 1, 1}}})->at({1, 1, 3}) == 2);
}

TEST_CASE("the distance to a segment is that of a march along it") {
    std::mt19937 random(3);
    for (const Attractor& s : random_attractors(0, 50, 0, 4)) {
        const dvec3 p = checks::random_point(random, space);
        const double d = make_distance_grading({s})->at(p);
        CHECK(d <= marched(s, p) + 1e-12);
        CHECK(d >= marched(s, p) - glm::length(s.b - s.a) / 1000);
    }
}

TEST_CASE("the nearest of many attractors is that of a search through all") {
    for (const auto& list : {random_attractors(500, 500, 0, 1), random_attractors(200, 0, 5, 2),
                             random_attractors(0, 3, 0, 3), random_attractors(1, 1, 1, 4)}) {
        const GradingPtr distance = make_distance_grading(list);
        std::mt19937 random(5);
        for (int i = 0; i < 1000; ++i) {
            const dvec3 p = checks::random_point(random, grown(space, 20));
            if (std::abs(distance->at(p) - brute_distance(list, p)) > 1e-12) FAIL("another one is nearer");
        }
        checks::check_ranges(*distance, space);
    }
}

TEST_CASE("ranges of distances are exact for one point and one plane") {
    const Box box{{1, 2, 3}, {4, 6, 3}};
    const Interval point = make_distance_grading({{Kind::point, {0, 2, 3}, {}}})->range(box);
    CHECK(point.lo == Approx(1).epsilon(1e-12));
    CHECK(point.hi == Approx(std::sqrt(32.0)).epsilon(1e-12));
    const Interval plane = make_distance_grading({{Kind::plane, {0, 0, 0}, {3, 4, 0}}})->range(box);
    CHECK(plane.lo == Approx(0.6 * 1 + 0.8 * 2).epsilon(1e-12));
    CHECK(plane.hi == Approx(0.6 * 4 + 0.8 * 6).epsilon(1e-12));
}

TEST_CASE("ranges of distances are narrow around a box far smaller than its distance") {
    const GradingPtr distance = make_distance_grading(random_attractors(1000, 1000, 0, 7));
    std::mt19937 random(9);
    for (int i = 0; i < 200; ++i) {
        const dvec3 at = checks::random_point(random, space);
        const double side = 0.01;
        CHECK(distance->range({at - side / 2, at + side / 2}).width() <= side * std::sqrt(3.0) + 1e-9);
    }
}

TEST_CASE("a hundred thousand attractors answer through their tree") {
    const auto list = random_attractors(50000, 50000, 0, 11);
    const GradingPtr distance = make_distance_grading(list);
    std::mt19937 random(12);
    for (int i = 0; i < 20; ++i) {
        const dvec3 p = checks::random_point(random, space);
        CHECK(distance->at(p) == Approx(brute_distance(list, p)).epsilon(1e-12));
    }
    const std::vector<Attractor> stacked(100000, {Kind::point, {1, 0, 0}, {}});
    CHECK(make_distance_grading(stacked)->at({4, 4, 0}) == 5);
}

TEST_CASE("attractors that are none are refused by number") {
    CHECK(message_of({}) == "a distance needs at least one point, segment or plane");
    CHECK(message_of({{Kind::point, {0, 0, 0}, {}}, {Kind::plane, {0, 0, 0}, {0, 0, 0}}}) ==
          "attractor 2: the normal of a plane must not be 0");
    CHECK(message_of({{Kind::point, {0, std::nan(""), 0}, {}}}).find("attractor 1: coordinates") == 0);
    CHECK(message_of({{Kind::segment, {0, 0, 0}, {0, infinity, 0}}}).find("attractor 1: coordinates") == 0);
}

TEST_CASE("falloffs follow their formulas between near and far") {
    const GradingPtr plane = make_distance_grading({{Kind::plane, {0, 0, 0}, {0, 0, 1}}});
    const auto at = [&](Falloff falloff, double z) {
        return make_falloff_grading(plane, 2, 10, 4, falloff)->at({0, 0, z});
    };
    for (const Falloff falloff : {Falloff::linear, Falloff::smooth, Falloff::gaussian, Falloff::inverse}) {
        CHECK(at(falloff, 0) == 2);
        CHECK(at(falloff, -3) == 2);
    }
    CHECK(at(Falloff::linear, 1) == 4);
    CHECK(at(Falloff::linear, 4) == 10);
    CHECK(at(Falloff::linear, 9) == 10);
    CHECK(at(Falloff::smooth, 2) == 6);
    CHECK(at(Falloff::smooth, 1) == Approx(2 + 8 * (3.0 / 16 - 2.0 / 64)));
    CHECK(at(Falloff::smooth, 4) == 10);
    CHECK(at(Falloff::inverse, 4) == 6);
    CHECK(at(Falloff::inverse, 12) == 8);
    for (const double z : {0.1, 1.0, 2.5, 4.0, 9.0, 40.0, 4000.0}) {
        CHECK(at(Falloff::gaussian, z) ==
              Approx(10 - 8 * std::exp(-4.5 * z * z / 16)).epsilon(1e-14).margin(1e-14));
    }
}

TEST_CASE("falloffs are monotone, so their ranges are exact") {
    const GradingPtr distance = make_distance_grading(random_attractors(20, 20, 0, 21));
    for (const Falloff falloff : {Falloff::linear, Falloff::smooth, Falloff::gaussian, Falloff::inverse}) {
        checks::check_ranges(*make_falloff_grading(distance, 3, 1, 12, falloff), space);
        checks::check_ranges(*make_falloff_grading(distance, -1, 1, 12, falloff), space);
        const GradingPtr x = make_distance_grading({{Kind::plane, {0, 0, 0}, {1, 0, 0}}});
        const GradingPtr graded = make_falloff_grading(x, 3, 1, 10, falloff);
        const Interval range = graded->range({{1, 0, 0}, {6, 9, 9}});
        CHECK(range.hi == Approx(graded->at({1, 0, 0})).epsilon(1e-12));
        CHECK(range.lo == Approx(graded->at({6, 0, 0})).epsilon(1e-12));
    }
}

TEST_CASE("a falloff stays undefined where its distance is") {
    const GradingPtr undefined = make_constant_grading(std::nan(""));
    const GradingPtr graded = make_falloff_grading(undefined, 1, 2, 3, Falloff::linear);
    CHECK(std::isnan(graded->at({0, 0, 0})));
    CHECK(graded->range(space).hi == infinity);
    CHECK_THROWS_AS(make_falloff_grading(undefined, 1, 2, 0, Falloff::linear), InputError);
    CHECK_THROWS_AS(make_falloff_grading(undefined, 1, infinity, 1, Falloff::linear), InputError);
}

}  // namespace attractors_test
