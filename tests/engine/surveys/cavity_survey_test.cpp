// The cavity survey: hollow balls, a leak, nested and random bubbles, threads, refusals.
#include "engine/surveys/cavity_survey.h"

#include <catch2/catch.hpp>
#include <random>

#include "engine/base/error.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"
#include "tests/engine/surveys/island_scenes.h"

namespace cavity_survey_test {

using namespace lamella;

namespace {

double ball_volume(double r) { return 4.0 / 3 * pi * r * r * r; }

CavitySurvey surveyed(const FieldPtr& part, double pitch = 0.1, int threads = 2) {
    CavitySurveyOptions options;
    options.pitch = pitch;
    options.threads = threads;
    return survey_cavities(scenes::job_of(part, part->bounds(), 0.1), options);
}

}  // namespace

TEST_CASE("the cavity of a hollow ball has its volume, its lowest and its highest point") {
    const dvec3 center(1, -2, 0.5);
    const FieldPtr part = make_difference(make_sphere({0, 0, 0}, 8), make_sphere(center, 4));
    const CavitySurvey survey = surveyed(part);
    REQUIRE(survey.count == 1);
    const Cavity& cavity = survey.cavities.front();
    CHECK(cavity.volume == Approx(ball_volume(4)).epsilon(2e-3));
    CHECK(survey.volume == cavity.volume);
    // Within a layer; a cap of a layer's height is sqrt(2 * 4 * 0.1) mm wide.
    CHECK(cavity.lowest.z == Approx(center.z - 4).margin(0.15));
    CHECK(cavity.highest.z == Approx(center.z + 4).margin(0.15));
    CHECK(cavity.lowest.x == Approx(center.x).margin(0.15));
    CHECK(cavity.lowest.y == Approx(center.y).margin(0.15));
    CHECK(part->value(cavity.lowest) > 0);
    CHECK(part->value(cavity.highest) > 0);
}

TEST_CASE("a cavity with a way out is none, whichever way that leads") {
    const FieldPtr hollow = make_difference(make_sphere({0, 0, 0}, 8), make_sphere({0, 0, 0}, 5));
    for (const dvec3 way :
         {dvec3(1, 0, 0), dvec3(0, 1, 0), dvec3(0, 0, 1), dvec3(0, 0, -1), dvec3(-0.6, 0, 0.8)}) {
        const FieldPtr drilled = make_difference(hollow, make_cylinder({0, 0, 0}, way * 9.0, 0.5));
        CHECK(surveyed(drilled).count == 0);
    }
    // A bore that ends in the skin opens nothing.
    CHECK(surveyed(make_difference(hollow, make_cylinder({0, 0, 6}, {0, 0, 9}, 0.5))).count == 1);
}

TEST_CASE("an onion has a cavity between any two of its layers") {
    std::vector<FieldPtr> layers;
    for (const double r : {9.0, 6.0, 3.0})
        layers.push_back(make_difference(make_sphere({0, 0, 0}, r), make_sphere({0, 0, 0}, r - 1)));
    const CavitySurvey survey = surveyed(make_union(layers));
    REQUIRE(survey.count == 3);
    CHECK(survey.cavities[0].volume == Approx(ball_volume(8) - ball_volume(6)).epsilon(2e-3));
    CHECK(survey.cavities[1].volume == Approx(ball_volume(5) - ball_volume(3)).epsilon(4e-3));
    CHECK(survey.cavities[2].volume == Approx(ball_volume(2)).epsilon(8e-3));
    CHECK(survey.cavities[1].lowest.z == Approx(-5).margin(0.15));
}

TEST_CASE("a cavity of two chambers joined at the top is one, and lowest in the deeper one") {
    const FieldPtr block = make_box({{-10, -5, -10}, {10, 5, 10}});
    const FieldPtr chambers =
        make_union({make_box({{-8, -3, -2}, {-4, 3, 8}}), make_box({{2, -3, -7}, {6, 3, 6}}),
                    make_box({{-6, -1, 4}, {4, 1, 5}})});
    const CavitySurvey survey = surveyed(make_difference(block, chambers));
    REQUIRE(survey.count == 1);
    const Cavity& cavity = survey.cavities.front();
    CHECK(cavity.volume == Approx(4 * 6 * 10 + 4 * 6 * 13 + 6 * 2 * 1).epsilon(0.01));
    CHECK(cavity.lowest.x == Approx(4).margin(0.1));
    CHECK(cavity.lowest.y == Approx(0).margin(0.1));
    CHECK(cavity.lowest.z == Approx(-6.95).margin(0.06));
    CHECK(cavity.highest.x == Approx(-6).margin(0.1));
    CHECK(cavity.highest.z == Approx(7.95).margin(0.06));
}

TEST_CASE("random bubbles are all found, by any number of threads alike") {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> at(-8, 8), size(0.4, 1.2);
    std::vector<std::pair<dvec3, double>> bubbles;
    std::vector<FieldPtr> balls;
    double volume = 0;
    while (bubbles.size() < 60) {
        const dvec3 p(at(random), at(random), at(random));
        const double r = size(random);
        bool clear = true;
        for (const auto& [q, s] : bubbles) clear = clear && glm::length(p - q) > r + s + 0.4;
        if (!clear) continue;
        bubbles.emplace_back(p, r);
        balls.push_back(make_sphere(p, r));
        volume += ball_volume(r);
    }
    const FieldPtr part = make_difference(make_box({dvec3(-10), dvec3(10)}), make_union(balls));
    const CavitySurvey survey = surveyed(part);
    CHECK(survey.count == 60);
    CHECK(survey.volume == Approx(volume).epsilon(0.01));
    const CavitySurvey other = surveyed(part, 0.1, 5);
    REQUIRE(other.cavities.size() == survey.cavities.size());
    for (std::size_t i = 0; i < other.cavities.size(); ++i) {
        CHECK(other.cavities[i].volume == survey.cavities[i].volume);
        CHECK(other.cavities[i].lowest == survey.cavities[i].lowest);
    }
}

TEST_CASE("a pitch that does not suit the part is refused") {
    const FieldPtr ball = make_sphere({0, 0, 0}, 2);
    CHECK_THROWS_WITH(surveyed(ball, 0), Catch::Contains("accepted"));
    CHECK_THROWS_WITH(surveyed(ball, 50), Catch::Contains("accepted"));
}

}  // namespace cavity_survey_test
