// What [repair] does to a part, and what it tells of it.
#include "recipe/build/repair_job.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "recipe/identity.h"
#include "tests/app/commands/recipes.h"

namespace repair_job_test {

using namespace lamella;

namespace {

// Bare foam of struts 0.3 mm thick: they are too thin for a bead, and some are cut off at the box.
const std::string foam =
    "[part]\nshape = \"box\"\nsize = [12, 12, 8]\n[foam]\ncell = 4\nbeam = 0.15\n[layers]\nheight = 0.2\n";
// A comb: seven slots 0.4 mm wide between walls of 0.8, and a step at either end.
const std::string comb =
    "[part]\nfield = \"comb\"\n[[field]]\nname = \"comb\"\nformula = \"max(max(max(abs(x) - 5, abs(y) - "
    "5), abs(z) - 2), min(0.2 - abs(x - 1.2 * floor(x / 1.2 + 0.5)), 4 - y))\"\n"
    "bounds = [[-5.1, -5.1, -2.1], [5.1, 5.1, 2.1]]\n";

// A wall with an arm, and a tongue 0.2 mm high that hangs below its end.
const std::string hook =
    "[part]\nfield = \"hook\"\n[layers]\nheight = 0.05\n[[field]]\nname = \"hook\"\nformula = \"min(min("
    "max(max(abs(x) - 1, abs(y) - 2), abs(z - 1.5) - 1.5), max(max(abs(x - 2) - 2, abs(y) - 1), abs(z - 2.4) "
    "- "
    "0.4)), max(max(abs(x - 3) - 0.5, abs(y) - 0.5), abs(z - 1.95) - 0.15))\"\n"
    "bounds = [[-1, -2, 0], [4, 2, 3]]\n";

BuiltJob repaired(const std::string& text) {
    const Recipe recipe = recipe_of(text);
    BuiltJob built = build_job(recipe);
    repair_job(recipe, built, {});
    return built;
}

CheckResult found(const Job& job, Check check, double limit) {
    PrintCheckOptions options;
    options.limits.verdicts[static_cast<std::size_t>(check)] = Severity::fail;
    options.limits.thickness = options.limits.gap = limit;
    options.pitch = 0.06;
    PrintCheck checks(job, options);
    survey_layers(job, checks, {});
    return checks.report().results.front();
}

}  // namespace

TEST_CASE("without [repair] a part stays as it is", "[repair]") {
    const BuiltJob built = repaired(foam);
    CHECK(!built.repairs);
    CHECK(job_identity(recipe_of(foam)) == built.job.identity);
    CHECK(job_identity(recipe_of(foam + "[repair]\njoin = 0.5\n")) != built.job.identity);
}

TEST_CASE("pieces of a foam are joined to one", "[repair]") {
    const std::size_t loose = found(repaired(foam).job, Check::connectivity, 0.4).count;
    REQUIRE(loose > 0);
    const BuiltJob built = repaired(foam + "[repair]\njoin = 0.6\n");
    REQUIRE(built.repairs->joins);
    CHECK(built.repairs->joins->pieces > loose / 2);
    CHECK(built.repairs->joins->joins.size() == built.repairs->joins->pieces - 1);
    CHECK(found(built.job, Check::connectivity, 0.4).count == 0);
    const auto json = repairs_json(*built.repairs);
    CHECK(json["joined"]["struts"].size() == built.repairs->joins->joins.size());
    CHECK(!json.contains("thickened"));
    CHECK_THAT(repairs_text(*built.repairs), Catch::StartsWith("join "));
}

TEST_CASE("struts too thin are counted and made thicker", "[repair]") {
    const CheckResult before = found(repaired(foam).job, Check::thickness, 0.5);
    REQUIRE(before.total > 10);
    const BuiltJob built = repaired(foam + "[repair]\nthickness = 0.5\n");
    CHECK(built.repairs->thickened->total == Approx(before.total).epsilon(0.2));
    CHECK(built.repairs->thickened->limit == 0.5);
    const CheckResult after = found(built.job, Check::thickness, 0.5);
    // Only what is cut off at the part's ends, where a layer may hold a speck alone, can be left.
    CHECK(after.total < 0.02 * before.total);
    CHECK(built.job.bounds.size().x == Approx(12.5));
}

TEST_CASE("gaps too narrow are counted and filled", "[repair]") {
    REQUIRE(found(repaired(comb).job, Check::gaps, 0.6).count == 7);
    const BuiltJob built = repaired(comb + "[repair]\ngap = 0.6\n");
    CHECK(built.repairs->filled->count == 7);
    CHECK(found(built.job, Check::gaps, 0.6).count == 0);
    CHECK(repairs_json(*built.repairs)["filled"]["places"] == 7);
    CHECK(repaired(comb + "[repair]\ngap = 0.2\n").repairs->filled->count == 0);
}

TEST_CASE("repairs are in mm as printed", "[repair]") {
    const BuiltJob built =
        repaired(foam + "[process]\nscale = [2, 2, 2]\n[repair]\nthickness = 0.5\njoin = 1\n");
    // Twice as large its struts are thick enough, but for those that the box cuts lengthwise.
    CHECK(built.repairs->thickened->total <
          0.1 * repaired(foam + "[repair]\nthickness = 0.5\n").repairs->thickened->total * 8);
    CHECK(found(built.job, Check::connectivity, 0.5).count == 0);
}

TEST_CASE("tips are trimmed as printed, and the higher ones told", "[repair]") {
    REQUIRE(found(repaired(hook).job, Check::islands, 0.4).count == 1);
    const BuiltJob built = repaired(hook + "[repair]\ntrim = 0.2\n");
    REQUIRE(built.repairs->tips);
    CHECK(built.repairs->tips->trimmed == 1);
    CHECK(found(built.job, Check::islands, 0.4).count == 0);
    CHECK(repairs_json(*built.repairs)["trimmed"]["tips"] == 1);
    CHECK_THAT(repairs_text(*built.repairs), Catch::StartsWith("trim       1 tip up to 0.2 mm high"));
    // Twice as large, the tongue is 0.4 mm high.
    const std::string twice = hook + "[process]\nscale = [2, 2, 2]\n";
    const BuiltJob high = repaired(twice + "[repair]\ntrim = 0.3\n");
    CHECK(high.repairs->tips->trimmed == 0);
    REQUIRE(high.repairs->tips->higher == 1);
    CHECK(high.repairs->tips->kept.front().height == Approx(0.4));
    CHECK_THAT(repairs_text(*high.repairs), Catch::Contains("1 tip higher than that, the highest 0.40 mm"));
    CHECK(found(repaired(twice + "[repair]\ntrim = 0.4\n").job, Check::islands, 0.4).count == 0);
}

TEST_CASE("what begins just above the bed gets struts to where the body stands on it", "[repair]") {
    // A ball without what it stands on: its lowest points are a ring, in the third layer.
    const std::string ring =
        "[part]\nshape = \"sphere\"\nradius = 10\n[layers]\nheight = 0.05\n[[field]]\nname = \"hole\"\n"
        "formula = \"hypot(x, y) - 1.3\"\nbounds = [[-2, -2, -10], [2, 2, -9]]\n"
        "[[region]]\nfield = \"hole\"\nmake = \"empty\"\n";
    const BuiltJob left = repaired(ring + "[repair]\ntrim = 0.2\n"),
                   held = repaired(ring + "[repair]\ntrim = 0.2\nhold = 0.8\n");
    REQUIRE(held.repairs->tips->on_bed.size() == 1);
    CHECK(held.repairs->tips->begins.empty());
    CHECK(held.repairs->tips->on_bed.front().z == Approx(-9.875));
    REQUIRE(held.repairs->holds.size() == 1);
    CHECK(held.repairs->holds.front().b.z == Approx(-10));
    const dvec2 foot(held.repairs->holds.front().b);
    CHECK(left.job.part->value({foot, left.job.plane(0)}) > 0);
    CHECK(held.job.part->value({foot, held.job.plane(0)}) < 0);
    for (const Check check : {Check::islands, Check::connectivity})
        CHECK(found(held.job, check, 0.4).count == 0);
    // A ball that stands on the bed needs none.
    CHECK(repaired("[part]\nshape = \"sphere\"\nradius = 10\n[repair]\ntrim = 0.2\nhold = 0.8\n")
              .repairs->holds.empty());
}

TEST_CASE("higher tips get struts down to the part", "[repair]") {
    // A box with a hall in it: a floor, a wall, and a roof with a tongue that hangs from it.
    const std::string hall =
        "[part]\nshape = \"box\"\nsize = [6, 4, 4]\n[layers]\nheight = 0.05\n[[field]]\nname = \"hall\"\n"
        "formula = \"max(max(-1.5 - z, z - 1.5), max(-1 - x, min(0.4 - abs(x - 2), z + 0.75)))\"\n"
        "bounds = [[-1, -2, -1.5], [3, 2, 1.5]]\n[[region]]\nfield = \"hall\"\nmake = \"empty\"\n";
    REQUIRE(found(repaired(hall).job, Check::islands, 0.4).count == 1);
    const BuiltJob left = repaired(hall + "[repair]\ntrim = 0.2\n");
    CHECK(left.repairs->tips->higher == 1);
    CHECK(left.repairs->holds.empty());
    const BuiltJob held = repaired(hall + "[repair]\ntrim = 0.2\nhold = 0.8\n");
    REQUIRE(held.repairs->holds.size() == 1);
    CHECK(held.repairs->holds.front().b.z == Approx(-1.7).margin(0.06));
    CHECK(found(held.job, Check::islands, 0.4).count == 0);
    CHECK(found(held.job, Check::connectivity, 0.4).count == 0);
    CHECK(repairs_json(*held.repairs)["held"].size() == 1);
    CHECK_THAT(repairs_text(*held.repairs), Catch::Contains("hold       1 strut"));
    // A strut never leaves the body; without trimming, what stays is the same.
    CHECK(repaired(hook + "[process]\nscale = [2, 2, 2]\n[repair]\ntrim = 0.3\nhold = 1\n")
              .repairs->holds.empty());
    CHECK(repaired(hall + "[repair]\nhold = 0.8\n").repairs->holds == held.repairs->holds);
    // So is a tip of a single layer, which trimming would remove.
    std::string low = hall;
    low.replace(low.find("z + 0.75"), 8, "z - 1.46");
    CHECK(repaired(low + "[repair]\ntrim = 0.2\nhold = 0.8\n").repairs->holds.empty());
    const BuiltJob kept = repaired(low + "[repair]\nhold = 0.8\n");
    CHECK(kept.repairs->holds.size() == 1);
    CHECK(kept.repairs->tips->removed->empty());
    CHECK_THAT(repairs_text(*kept.repairs), !Catch::Contains("trim"));
}

TEST_CASE("self-supporting skins are trimmed unless the recipe says otherwise", "[repair]") {
    const std::string skin =
                          "[part]\nshape = \"sphere\"\nradius = 9\n[skin]\nthickness = 1\npattern = "
                          "\"by-example\"\nimage = \"x.png\"\nimage_size = 20\nstrut = 0.6\n",
                      held = skin + "self_supporting = true\n";
    CHECK(trim_height(recipe_of(skin)) == 0);
    CHECK(trim_height(recipe_of(held)) == Approx(0.15));
    CHECK(trim_height(recipe_of(held + "[repair]\njoin = 1\n")) == Approx(0.15));
    CHECK(trim_height(recipe_of(held + "[repair]\ntrim = 0\n")) == 0);
    CHECK(trim_height(recipe_of(skin + "[repair]\ntrim = 0.4\n")) == Approx(0.4));
    CHECK(trim_height(recipe_of(skin + "[repair]\njoin = 1\n")) == 0);
    CHECK(hold_diameter(recipe_of(skin)) == 0);
    CHECK(hold_diameter(recipe_of(held)) == 0.6);
    CHECK(hold_diameter(recipe_of(held + "[repair]\nhold = 0\n")) == 0);
    CHECK(hold_diameter(recipe_of(skin + "[repair]\nhold = 0.5\n")) == 0.5);
}

TEST_CASE("repairs that make no sense are refused", "[repair]") {
    CHECK_THAT(complaint_about(foam + "[repair]\nthickness = -1\n"), Catch::Contains("repair.thickness"));
    CHECK_THAT(complaint_about(foam + "[repair]\nholes = 1\n"), Catch::Contains("holes"));
}

}  // namespace repair_job_test
