// Joins: as many as it takes, each about as short as the pieces are apart, and with them all is one piece.
#include "engine/surveys/piece_joins.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "engine/base/error.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"
#include "tests/engine/surveys/island_scenes.h"

namespace piece_joins_test {

using namespace lamella;

namespace {

JoinSurvey joins_of(const FieldPtr& part, double pitch = 0.1, double h = 0.1, int threads = 0) {
    JoinSurveyOptions options;
    options.pitch = pitch;
    options.threads = threads;
    return survey_joins(scenes::job_of(part, part->bounds(), h), options);
}

/// The part with a strut along every join.
FieldPtr joined(const FieldPtr& part, const JoinSurvey& survey, double radius) {
    std::vector<FieldPtr> solids{part};
    for (const PieceJoin& join : survey.joins) {
        const dvec3 way = join.length() > 0 ? (join.b - join.a) / join.length() : dvec3(0);
        solids.push_back(make_round_cone({join.a - way * radius, radius, join.b + way * radius, radius}));
    }
    return make_union(solids);
}

}  // namespace

TEST_CASE("one piece needs no joins", "[joins]") {
    const JoinSurvey survey = joins_of(make_sphere(dvec3(0), 4));
    CHECK(survey.pieces == 1);
    CHECK(survey.joins.empty());
}

TEST_CASE("two balls are joined where they are nearest", "[joins]") {
    const dvec3 a(0, 0, 0), b(9, 5, 4);
    const JoinSurvey survey = joins_of(make_union({make_sphere(a, 3), make_sphere(b, 4)}));
    REQUIRE(survey.pieces == 2);
    REQUIRE(survey.joins.size() == 1);
    const double apart = glm::distance(a, b) - 7;
    CHECK(survey.joins[0].length() == Approx(apart).margin(0.12));
    const dvec3 way = (b - a) / glm::distance(a, b);
    const bool from_a = glm::distance(survey.joins[0].a, a) < glm::distance(survey.joins[0].a, b);
    const dvec3 low = from_a ? survey.joins[0].a : survey.joins[0].b;
    CHECK(glm::distance(low, a + way * 3.0) < 0.9);  // flat places: many ways are nearly as short
}

TEST_CASE("a box beside another one, over another one, and far off", "[joins]") {
    const auto box = [](dvec3 lo, dvec3 hi) { return make_box({lo, hi}); };
    const FieldPtr floor = box({0, 0, 0}, {20, 20, 2});
    const auto length = [&](const FieldPtr& other) {
        const JoinSurvey survey = joins_of(make_union({floor, other}));
        REQUIRE(survey.joins.size() == 1);
        return survey.joins[0].length();
    };
    // Rows and layers are known to one of their own.
    CHECK(length(box({23, 5, 0}, {25, 8, 2})) == Approx(3).margin(0.02));
    CHECK(length(box({5, 23, 0}, {8, 25, 2})) == Approx(3).margin(0.11));
    CHECK(length(box({5, 5, 5}, {8, 8, 7})) == Approx(3).margin(0.11));
    CHECK(length(box({60, 50, 40}, {61, 51, 41})) == Approx(std::sqrt(1600.0 + 900 + 38 * 38)).margin(0.3));
}

TEST_CASE("many pieces become one, with joins not much longer than a shortest tree", "[joins]") {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> at(0, 30), size(0.5, 2);
    std::vector<FieldPtr> balls;
    std::vector<std::pair<dvec3, double>> known;
    for (int i = 0; i < 40; ++i) {
        known.emplace_back(dvec3(at(random), at(random), at(random)), size(random));
        balls.push_back(make_sphere(known.back().first, known.back().second));
    }
    const FieldPtr part = make_union(balls);
    const JoinSurvey survey = joins_of(part);
    CHECK(survey.pieces > 20);
    REQUIRE(survey.joins.size() == survey.pieces - 1);
    CHECK(joins_of(joined(part, survey, 0.3)).pieces == 1);
    // Prim's tree over the balls' exact distances.
    std::vector<double> away(known.size(), 1e9);
    std::vector<bool> inside(known.size(), false);
    double shortest = 0;
    away[0] = 0;
    for (std::size_t round = 0; round < known.size(); ++round) {
        std::size_t next = known.size();
        for (std::size_t i = 0; i < known.size(); ++i) {
            if (!inside[i] && (next == known.size() || away[i] < away[next])) next = i;
        }
        inside[next] = true;
        shortest += away[next];
        for (std::size_t i = 0; i < known.size(); ++i) {
            const double gap =
                glm::distance(known[i].first, known[next].first) - known[i].second - known[next].second;
            away[i] = std::min(away[i], std::max(gap, 0.0));
        }
    }
    double total = 0;
    for (const PieceJoin& join : survey.joins) total += join.length();
    CHECK(total > 0.9 * shortest);
    CHECK(total < 1.15 * shortest);
}

TEST_CASE("joins are the same by any number of threads", "[joins]") {
    std::vector<FieldPtr> balls;
    for (int i = 0; i < 12; ++i)
        balls.push_back(make_sphere({5.0 * (i % 4), 4.7 * (i / 4), 2.0 * (i % 3)}, 1.5));
    const JoinSurvey one = joins_of(make_union(balls), 0.1, 0.1, 1),
                     four = joins_of(make_union(balls), 0.1, 0.1, 4);
    REQUIRE(one.joins.size() == four.joins.size());
    CHECK(one.joins.size() == 11);
    for (std::size_t i = 0; i < one.joins.size(); ++i) {
        CHECK(one.joins[i].a == four.joins[i].a);
        CHECK(one.joins[i].b == four.joins[i].b);
    }
}

TEST_CASE("what cannot be joined is refused", "[joins]") {
    std::vector<FieldPtr> balls;
    for (int i = 0; i < 12; ++i) balls.push_back(make_sphere({5.0 * i, 0, 0}, 1));
    const Job job = scenes::job_of(make_union(balls), make_union(balls)->bounds(), 0.1);
    JoinSurveyOptions options;
    options.max_pieces = 10;
    CHECK_THROWS_WITH(survey_joins(job, options), Catch::Contains("12 pieces"));
    options.pitch = 100;
    CHECK_THROWS_AS(survey_joins(job, options), InputError);
}

}  // namespace piece_joins_test
