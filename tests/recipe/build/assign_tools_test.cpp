// Which tool makes which point, against closed forms.
#include "recipe/build/assign_tools.h"

#include <catch2/catch.hpp>
#include <random>

#include "recipe/build/finish_job.h"
#include "recipe/output/plated_job.h"
#include "recipe/recipe_draft.h"

namespace assign_tools_test {

using namespace lamella;

namespace {

const std::string tools =
    "[[tool]]\nname = \"a\"\n[[tool]]\nname = \"b\"\n[[tool]]\nname = \"c\"\n"
    "[layers]\nheight = 0.2\n[printer]\nprofile = \"marlin\"\n";

Recipe recipe_of(const std::string& text) {
    RecipeDraft draft;
    draft.read_text(text, "tools.toml");
    return draft.finish();
}

BuiltJob built_of(const std::string& text) {
    const Recipe recipe = recipe_of(text);
    BuiltJob built = build_job(recipe);
    finish_job(recipe, built, {.plans = {}});
    return built;
}

int tool_at(const std::vector<ToolZone>& zones, dvec3 p) {
    int tool = 0;
    for (const ToolZone& zone : zones) {
        if (!zone.zone || zone.zone->value(p) < 0) tool = zone.tool;
    }
    return tool;
}

/// Random points of a ball.
std::vector<dvec3> points_in_ball(double radius, int count) {
    std::mt19937_64 bits(3);
    std::vector<dvec3> points;
    while (points.size() < static_cast<std::size_t>(count)) {
        const auto number = [&] { return static_cast<double>(bits() >> 11U) * 0x1p-52 - 1; };
        const dvec3 p = radius * dvec3(number(), number(), number());
        if (glm::length(p) < radius) points.push_back(p);
    }
    return points;
}

}  // namespace

TEST_CASE("skin, foam and regions have tools of their own", "[tools]") {
    const std::string side = GENERATE("inside", "outside", "centred");
    const BuiltJob built = built_of(
        "[part]\nshape = \"sphere\"\nradius = 10\ntool = \"b\"\nturn = [0, 90, 0]\n"
        "[foam]\ncell = 4\nbeam = 0.4\n[skin]\nthickness = 2\ntool = \"a\"\nside = \"" +
        side +
        "\"\n"
        "[[field]]\nname = \"half\"\nformula = \"x - 4\"\n[[region]]\nfield = \"half\"\nmake = "
        "\"tool\"\ntool = "
        "\"c\"\n" +
        tools);
    const double inner = side == "inside" ? 8 : side == "outside" ? 10 : 9;
    for (const dvec3 p : points_in_ball(11.9, 3000)) {
        // Turned about y by 90 degrees: what was x points along -z.
        const int expected = -p.z < 4 ? 2 : glm::length(p) < inner ? 1 : 0;
        if (std::abs(glm::length(p) - inner) < 1e-6 || std::abs(-p.z - 4) < 1e-6) continue;
        if (glm::length(p) > (side == "inside" ? 10 : side == "outside" ? 12 : 11)) continue;
        CHECK(tool_at(built.job.part_tools, p) == expected);
    }
}

TEST_CASE("supports have a tool, and another near the part", "[tools]") {
    const BuiltJob built = built_of(
        "[part]\nshape = \"sphere\"\nradius = 10\n"
        "[support]\nkind = \"pillars\"\ntool = \"b\"\ninterface_tool = \"c\"\ninterface = 1.5\n" +
        tools);
    REQUIRE(built.job.supports);
    CHECK(built.job.part_tools.empty());
    for (const dvec3 p : points_in_ball(13, 2000)) {
        if (!built.job.bounds.contains(p) || glm::length(p) < 10) continue;
        CHECK(tool_at(built.job.support_tools, p) == (glm::length(p) < 11.5 ? 2 : 1));
    }
}

TEST_CASE("a part of the first tool alone has no zones and no tower", "[tools]") {
    const BuiltJob built = built_of("[part]\nshape = \"sphere\"\nradius = 10\ntool = \"a\"\n" + tools);
    CHECK(built.job.part_tools.empty());
    const PlateItem item{built.job, 1};
    CHECK_FALSE(put_on_plates(recipe_of("[part]\nshape = \"sphere\"\nradius = 10\n" + tools), {&item, 1}, {})
                    .job.purge_tower);
}

TEST_CASE("names of tools are checked", "[tools]") {
    const auto part = [](const std::string& more) {
        return "[part]\nshape = \"sphere\"\nradius = 10\n" + more;
    };
    CHECK_THROWS_WITH(
        recipe_of(part("tool = \"hard\"\n[[tool]]\nname = \"hart\"\n[printer]\nprofile = \"marlin\"\n")),
        Catch::Contains("tools.toml:4") && Catch::Contains("did you mean `hart`"));
    CHECK_THROWS_WITH(recipe_of(part("tool = \"hard\"\n")), Catch::Contains("the name of a [[tool]]"));
    CHECK_THROWS_WITH(recipe_of(part("[[tool]]\nname = \"x\"\n[[tool]]\nname = \"x\"\n")),
                      Catch::Contains("tools.toml:7") && Catch::Contains("name of another [[tool]]"));
    CHECK_THROWS_WITH(recipe_of(part("[[tool]]\nnozzle_temperature = 200\n")), Catch::Contains("name"));
    CHECK_THROWS_WITH(recipe_of(part("[support]\ninterface = 2\n")), Catch::Contains("has no effect"));
}

TEST_CASE("a single part stands where it is put", "[plate]") {
    const std::string text = "[part]\nshape = \"box\"\nsize = [20, 10, 5]\nat = [[15, -30]]\n" + tools;
    const BuiltJob built = built_of(text);
    const PlateItem item{built.job, 1};
    const Job job = put_on_plates(recipe_of(text), {&item, 1}, {}).job;
    CHECK(job.bounds.center().x == Approx(-15));
    CHECK(job.bounds.center().y == Approx(30));
    CHECK(job.bounds.size().x == Approx(20 + 2 * 15));
    CHECK(job.bounds.size().y == Approx(10 + 2 * 30));
    const PlateItem two{built.job, 2};
    CHECK_THROWS_WITH(put_on_plates(recipe_of(text), {&two, 1}, {}), Catch::Contains("part.at"));
}

}  // namespace assign_tools_test
