// Dowel holes go through every layer at the same place, with material about them.
#include "recipe/build/place_dowels.h"

#include <catch2/catch.hpp>

#include "recipe/build/build_job.h"
#include "tests/app/commands/recipes.h"

namespace place_dowels_test {

using namespace lamella;

namespace {

const std::string plate = "[part]\nshape = \"box\"\nsize = [60, 40, 20]\n[layers]\nheight = 2\n";

BuiltJob built(const std::string& text) { return build_job(recipe_of(plate + text)); }
std::string complaint(const std::string& text) { return complaint_about(plate + text); }

}  // namespace

TEST_CASE("the holes stand in every layer, round, clear of its border") {
    const int count = GENERATE(2, 3);
    const BuiltJob job = built("[printer]\nprofile = \"svg\"\ndowels = " + std::to_string(count) +
                               "\ndowel_diameter = 4\ndowel_margin = 3\n");
    REQUIRE(job.dowels);
    REQUIRE(job.dowels->at.size() == static_cast<std::size_t>(count));
    for (const dvec2& p : job.dowels->at) {
        CHECK(std::abs(p.x) <= 25 + 0.01);
        CHECK(std::abs(p.y) <= 15 + 0.01);
        for (int i = 0; i < job.job.layers.count(); ++i) {
            const double z = job.job.plane(i);
            CHECK(job.job.part->value({p.x, p.y, z}) > 1.9);
            for (const dvec2 side : {dvec2(1, 0), dvec2(-1, 0), dvec2(0, 1), dvec2(0, -1)}) {
                const dvec2 within = p + side * 2.1, beyond = p + side * 4.9;
                CHECK(job.job.part->value({within.x, within.y, z}) < 0);
                CHECK(job.job.part->value({beyond.x, beyond.y, z}) < 0);
            }
        }
    }
    for (int i = 0; i < job.job.layers.count(); ++i) {
        CHECK(Layer(job.job, i).contours(0.02).size() == static_cast<std::size_t>(count) + 1);
    }
}

TEST_CASE("holes stop at the height asked for, and layers above do not matter") {
    const std::string cone =
        "[[field]]\nname = \"cone\"\nformula = \"(sqrt(x^2 + y^2) - 30 + z) * 0.7\"\n"
        "bounds = [[-31, -31, 0], [31, 31, 29.9]]\n[part]\nfield = \"cone\"\n[layers]\nheight = 1\n";
    const std::string pins = "[printer]\nprofile = \"svg\"\ndowels = 3\n";
    CHECK_THAT(
        complaint_about(cone + pins),
        Catch::Contains("no place lies inside all layers up to layer 26") && Catch::Contains("dowel_height"));
    const BuiltJob job = build_job(recipe_of(cone + pins + "dowel_height = 10\n"));
    REQUIRE(job.dowels->at.size() == 3);
    CHECK(Layer(job.job, 9).contours(0.02).size() == 4);
    CHECK(Layer(job.job, 10).contours(0.02).size() == 1);
    for (const dvec2& p : job.dowels->at) CHECK(glm::length(p) <= 30 - 9.5 - 3.5 + 0.05);
}

TEST_CASE("places of one's own are checked in every layer") {
    const BuiltJob job = built("[printer]\nprofile = \"svg\"\ndowel_at = [[-20, 5], [22, -8]]\n");
    REQUIRE(job.dowels->at.size() == 2);
    CHECK(job.dowels->at[1] == dvec2(22, -8));
    CHECK(job.job.part->value({22, -8, 0}) > 0);
    CHECK_THAT(complaint("[printer]\nprofile = \"svg\"\ndowel_at = [[-20, 5], [28, -8]]\n"),
               Catch::Contains("(28, -8)") && Catch::Contains("layer 0") && Catch::Contains("3.5 mm inside"));
    CHECK_THAT(complaint("[printer]\ndowel_at = [[-20, 5]]\ndowels = 3\n"),
               Catch::Contains("1 places are given for 3 dowels"));
}

TEST_CASE("dowels that cannot be are refused") {
    CHECK_THAT(complaint("[printer]\ndowels = 1\n"), Catch::Contains("accepted: 0, 2 or 3"));
    CHECK_THAT(complaint("[printer]\ndowels = 3\ndowel_diameter = 15\n"), Catch::Contains("too small for 3"));
    CHECK_THAT(complaint("[printer]\ndowels = 2\ndowel_height = 0.5\n"), Catch::Contains("first layer"));
    CHECK_THAT(complaint("[printer]\ndowels = 4\n"), Catch::Contains("3"));
}

TEST_CASE("dowels change the job's identity") {
    const std::string svg = "[printer]\nprofile = \"svg\"\n";
    CHECK(built(svg).job.identity != built(svg + "dowels = 2\n").job.identity);
    CHECK(!built(svg).dowels);
}

TEST_CASE("a sheet's size needs no second brackets") {
    CHECK(recipe_of(plate + "[printer]\nsheet = [300, 200]\n").printer.cutting.sheet ==
          NumberRows{{300, 200}});
    CHECK_THAT(complaint("[printer]\nsheet = [300]\n"),
               Catch::Contains("the number of values in a row is 1 instead of 2"));
    CHECK_THAT(complaint("[printer]\nsheet = 300\n"), Catch::Contains("[w, h]"));
}

TEST_CASE("a recipe cannot ask for supports cut out of sheets") {
    const std::string supports = "[support]\nkind = \"bridges\"\n[printer]\nprofile = \"svg\"\n";
    CHECK(complaint(supports).empty());
    CHECK_THAT(complaint(supports + "kerf = 0.1\n"),
               Catch::Contains("support.kind") &&
                   Catch::Contains("a printer that cuts sheets cannot make supports"));
}

}  // namespace place_dowels_test
