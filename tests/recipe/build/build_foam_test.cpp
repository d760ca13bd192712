// Foams of a recipe that have more to them than cells and beams: walls, windows, directions.
#include "recipe/build/build_foam.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "app/reports/grading_report.h"
#include "tests/app/commands/recipes.h"

namespace build_foam_test {

using namespace lamella;

namespace {

const std::string ball = "[part]\nshape = \"sphere\"\nradius = 10\n[foam]\ncell = 3\nbeam = 0.2\n";

Recipe read(const std::string& foam) { return recipe_of(ball + foam); }

std::string complaint(const std::string& foam) { return complaint_about(ball + foam); }

const Box region{dvec3(-6), dvec3(6)};

/// The middle between a seed and the seed nearest to it lies on the face between their cells.
std::vector<dvec3> middles_of_faces(const BuiltFoam& foam) {
    const auto all = foam.seeds_in({region.lo - 6.0, region.hi + 6.0});
    std::vector<dvec3> middles;
    for (const Seed& seed : foam.seeds_in(region)) {
        double least = infinity;
        dvec3 middle{0};
        for (const Seed& other : all) {
            const double d = glm::length(other.position - seed.position);
            if (other.key == seed.key || !(d < least)) continue;
            least = d;
            middle = (seed.position + other.position) * 0.5;
        }
        middles.push_back(middle);
    }
    return middles;
}

/// The mean of |z| over length of the beams that touch a box.
double steepness(const BuiltFoam& foam, const Box& box) {
    double sum = 0;
    const auto beams = foam.beams_touching(box);
    for (const Beam& beam : beams) sum += std::abs(beam.b.z - beam.a.z) / glm::length(beam.b - beam.a);
    return sum / static_cast<double>(beams.size());
}

}  // namespace

TEST_CASE("a closed foam has walls between its cells, as thick as asked") {
    const BuiltFoam closed =
        build_foam_alone(read("kind = \"closed\"\nwall = \"0.3 + 0.01*z\"\nwall_max = 0.32\n"), region);
    const BuiltFoam open = build_foam_alone(read("kind = \"voronoi\"\n"), region);
    const auto middles = middles_of_faces(closed);
    REQUIRE(middles.size() > 40);
    std::size_t open_there = 0;
    for (const dvec3& middle : middles) {
        const double wall = std::min(0.3 + 0.01 * middle.z, 0.32);
        CHECK(closed.field->value(middle) < -0.4 * wall);
        open_there += open.field->value(middle) > 0;
    }
    CHECK(open_there > middles.size() * 3 / 4);
}

TEST_CASE("a closed foam that is all windows is the open foam of the same seeds") {
    const BuiltFoam windows = build_foam_alone(read("kind = \"closed\"\nwall = 0.1\nwindow = 1\n"), region);
    const BuiltFoam open = build_foam_alone(read("kind = \"voronoi\"\n"), region);
    CHECK(windows.beams_touching(region).size() == open.beams_touching(region).size());
    for (int i = 0; i < 2000; ++i) {
        const dvec3 p(std::fmod(i * 0.754877, 12.0) - 6, std::fmod(i * 0.569840, 12.0) - 6,
                      std::fmod(i * 0.430159, 12.0) - 6);
        CHECK(windows.field->value(p) == Approx(open.field->value(p)).margin(1e-12));
    }
}

TEST_CASE("windows open where the formula says so") {
    const BuiltJob built = build_job(read("kind = \"closed\"\nwall = 0.1\nwindow = \"z > 0 ? 0.9 : 0\"\n"));
    std::size_t above = 0, open_above = 0, open_below = 0;
    for (const dvec3& middle : middles_of_faces(*built.foam)) {
        const bool open = built.foam->field->value(middle) > 0;
        above += middle.z > 0.5;
        open_above += middle.z > 0.5 && open;
        open_below += middle.z < -0.5 && open;
    }
    CHECK(open_below == 0);
    CHECK(open_above > above / 2);
}

TEST_CASE("a k-nearest foam leans the way that its stretch says, place by place") {
    const BuiltJob built =
        build_job(read("kind = \"k-nearest\"\nneighbours = 4\nstretch = [1, 1, \"z > 0 ? 2 : 0.5\"]\n"));
    const double above = steepness(*built.foam, {{-3, -3, 2}, {3, 3, 5}});
    const double below = steepness(*built.foam, {{-3, -3, -5}, {3, 3, -2}});
    CHECK(above > 0.6);
    CHECK(below < 0.4);
    const BuiltJob turned =
        build_job(read("kind = \"k-nearest\"\nstretch = [3, 1, 1]\nturn = [0, \"z > 0 ? 90 : 0\", 0]\n"));
    CHECK(steepness(*turned.foam, {{-3, -3, 2}, {3, 3, 5}}) > 0.6);
    CHECK(steepness(*turned.foam, {{-3, -3, -5}, {3, 3, -2}}) < 0.4);
    // More neighbours, more beams.
    const Box box{dvec3(-5), dvec3(5)};
    const auto count = [&](const std::string& k) {
        return build_foam_alone(read("kind = \"k-nearest\"\nneighbours = " + k + "\n"), box)
            .beams_touching(box)
            .size();
    };
    CHECK(count("8") > count("3") * 3 / 2);
}

TEST_CASE("a stretch beyond what a k-nearest foam takes is kept within it and told") {
    const BuiltJob built = build_job(read("kind = \"k-nearest\"\nstretch = [1, 1, \"20 + z\"]\n"));
    const auto reports = grading_reports(built);
    REQUIRE(reports.size() == 1);
    CHECK(reports[0].key == "foam.stretch");
    CHECK(reports[0].unit.empty());
    CHECK(reports[0].clamped > 0.99);
    REQUIRE(warnings(reports[0]).size() == 1);
    CHECK_FALSE(mentions(warnings(reports[0])[0], "mm"));
}

TEST_CASE("stretches that a kind does not take are refused by their key") {
    CHECK(mentions(complaint("stretch = [1, 1, \"1 + z/20\"]\n"),
                   "test.toml:7: foam.stretch: must be constant for kind voronoi; accepted: three numbers"));
    CHECK(mentions(complaint("kind = \"k-nearest\"\nstretch = [1, 1, 15]\n"),
                   "test.toml:8: foam.stretch: 15 is too large for kind k-nearest; accepted: 0.1 to 10"));
    CHECK(mentions(complaint("kind = \"k-nearest\"\nstretch = [1, 1, \"1 + q\"]\n"),
                   "test.toml:8: foam.stretch (z): column 5: unknown name `q`"));
    CHECK(mentions(
        complaint("kind = \"k-nearest\"\nstretch = [1, \"x\"]\n"),
        "test.toml:8: foam.stretch: an array of 2 was found; accepted: three numbers from 0.05 to 20 or "
        "formulas"));
    CHECK(mentions(complaint("kind = \"k-nearest\"\nneighbours = 27\n"),
                   "test.toml:8: foam.neighbours: 27 is too large"));
    CHECK(mentions(complaint("kind = \"k-nearest\"\nstretch = [1, 1, \"z > 0 ? sqrt(-1) : 2\"]\n"),
                   "foam.stretch (z): the formula is undefined in 50 % of the part"));
    CHECK(mentions(complaint("kind = \"closed\"\n"), "foam.wall: missing, required by kind closed"));
}

}  // namespace build_foam_test
