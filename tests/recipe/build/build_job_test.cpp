// Jobs of a recipe: skins whose thickness varies, bodies from programs, and foam without what floats free.
#include "recipe/build/build_job.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/app/commands/recipes.h"

namespace build_job_test {

using namespace lamella;

namespace {

std::string ball_recipe(double radius, const std::string& text) {
    return "[part]\nshape = \"sphere\"\nradius = " + std::to_string(radius) + "\n" + text;
}

BuiltJob ball(double radius, const std::string& text) {
    return build_job(recipe_of(ball_recipe(radius, text)));
}

std::string complaint(double radius, const std::string& text) {
    return complaint_about(ball_recipe(radius, text));
}

const std::string loose_foam =
    "[layers]\nheight = 0.1\n[foam]\nkind = \"k-nearest\"\nneighbours = 2\ncell = 1.2\nbeam = "
    "0.12\ndrop_islands = true\n";

}  // namespace

TEST_CASE("a skin that has no number somewhere takes the stated limit there, or is refused") {
    const std::string half = "[skin]\nthickness = \"z > 0 ? sqrt(-1) : 0.5\"\n";
    const std::string refused = complaint(10, half);
    CHECK(mentions(refused, "test.toml:5: skin.thickness: the formula is undefined in 50 % of the part"));
    CHECK(mentions(refused, "skin.thickness_max / --skin-max"));
    const BuiltJob limited = ball(10, half + "thickness_max = 1\n");
    const Field& part = *limited.job.part;
    CHECK(part.value({0, 0, 9.05}) < 0);
    CHECK(part.value({0, 0, 8.95}) > 0);
    CHECK(part.value({0, 0, -9.55}) < 0);
    CHECK(part.value({0, 0, -9.45}) > 0);
}

TEST_CASE("a skin stays within its limits") {
    const BuiltJob built =
        ball(10, "[skin]\nthickness = \"1 + z\"\nthickness_min = 0.5\nthickness_max = 2\n");
    const Field& part = *built.job.part;
    CHECK(part.value({0, 0, 8.05}) < 0);
    CHECK(part.value({0, 0, 7.95}) > 0);
    CHECK(part.value({0, 0, -9.55}) < 0);
    CHECK(part.value({0, 0, -9.45}) > 0);
    CHECK(mentions(complaint(10, "[skin]\nthickness = 3\nthickness_max = 2\n"),
                   "test.toml:5: skin.thickness: 3 mm lies outside skin.thickness_min and "
                   "skin.thickness_max; accepted: 0 to 2 mm"));
}

TEST_CASE("no graded number of a foam is made up where the formula has none") {
    CHECK(mentions(complaint(10, "[foam]\ncell = \"z > 0 ? sqrt(-1) : 2\"\nbeam = 0.2\n"),
                   "test.toml:5: foam.cell: the formula is undefined in 50 % of the part"));
    CHECK(complaint(10, "[foam]\ncell = \"z > 0 ? sqrt(-1) : 2\"\ncell_max = 3\nbeam = 0.2\n").empty());
}

TEST_CASE("a body from a program is what the program says") {
    const BuiltJob built =
        build_job(recipe_of(std::string("[[field]]\nname = \"torus\"\nkind = \"vm\"\nfile = \"") +
                            LAMELLA_SOURCE_DIR + "/examples/inputs/cut_torus.vm\"\n"));
    CHECK(built.job.name == "torus");
    int inside = 0;
    for (int i = 0; i < 5000; ++i) {
        const dvec3 p(std::fmod(i * 0.754877, 28.0) - 14, std::fmod(i * 0.569840, 28.0) - 14,
                      std::fmod(i * 0.430159, 9.0) - 4.5);
        const double ring = std::sqrt(p.x * p.x + p.y * p.y) - 9;
        const double torus = std::max(std::sqrt(ring * ring + p.z * p.z) - 4, p.z - 2);
        if (std::abs(torus) < 1e-6) continue;
        CHECK((built.job.part->value(p) < 0) == (torus < 0));
        inside += torus < 0;
    }
    CHECK(inside > 500);
}

TEST_CASE("after islands are dropped a second survey finds none") {
    const Recipe recipe = recipe_of("[part]\nshape = \"sphere\"\nradius = 4\n" + loose_foam);
    BuiltJob built = build_job(recipe);
    drop_islands(recipe, built, {});
    const IslandReport first = *built.islands;
    CHECK(first.count > 3);
    CHECK(first.volume > 0);
    CHECK(first.too_large == 0);
    drop_islands(recipe, built, {});
    CHECK(built.islands->count == 0);
    CHECK(built.islands->components == 1);
    CHECK(built.islands->part_volume < first.part_volume);
    CHECK(built.islands->part_volume == Approx(first.part_volume - first.volume).epsilon(0.001));
}

TEST_CASE("the pitch of the survey is a third of the thinnest beam's radius or the recipe's") {
    // Islands lie in boxes of whole rows: their sides across are multiples of the pitch.
    const auto pitch_fits = [](const std::string& text, double pitch) {
        const Recipe recipe = recipe_of("[part]\nshape = \"sphere\"\nradius = 4\n" + text);
        BuiltJob built = build_job(recipe);
        drop_islands(recipe, built, {});
        REQUIRE(built.islands->count > 0);
        for (const Island& island : built.islands->largest) {
            const double rows = island.box.size().y / pitch;
            CHECK(rows == Approx(std::round(rows)).margin(1e-6));
        }
    };
    pitch_fits(loose_foam, 0.04);
    pitch_fits(loose_foam + "islands_pitch = 0.07\n", 0.07);
    const Recipe coarse =
        recipe_of("[part]\nshape = \"sphere\"\nradius = 4\n" + loose_foam + "islands_pitch = 3\n");
    BuiltJob built = build_job(coarse);
    CHECK_THROWS_WITH(drop_islands(coarse, built, {}),
                      Catch::Contains("foam.islands_pitch / --islands-pitch: 3 mm does not suit the part") &&
                          Catch::Contains("to 1.6 mm"));
    BuiltJob thin_layers =
        build_job(recipe_of("[part]\nshape = \"sphere\"\nradius = 1\n[layers]\nheight = 0.005\n"));
    CHECK_NOTHROW(drop_islands(recipe_of("[part]\nshape = \"sphere\"\nradius = 1\n"), thin_layers, {}));
}

}  // namespace build_job_test
