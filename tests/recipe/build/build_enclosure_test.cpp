// Recipes with cavities and shields: what each key does, and what they do not go together with.
#include "recipe/build/build_enclosure.h"

#include <catch2/catch.hpp>

#include "recipe/build/build_supports.h"
#include "tests/app/commands/recipes.h"

namespace build_enclosure_test {

using namespace lamella;

namespace {

const std::string box =
    "[part]\nshape = \"box\"\nsize = [20, 20, 20]\n[layers]\nheight = 0.2\n[printer]\nprofile = \"marlin\"\n";

HollowReport cavities_of(const std::string& text) { return *build_job(recipe_of(text)).cavities; }

double shield_of(const std::string& text) {
    const Recipe recipe = recipe_of(text);
    Job job = build_job(recipe).job;
    const double volume = add_shield(recipe, job, {1, nullptr})->volume;
    REQUIRE(job.supports != nullptr);
    return volume;
}

std::string identity_of(const std::string& text) { return build_job(recipe_of(text)).job.identity; }

}  // namespace

TEST_CASE("a cavity leaves its wall, and every key of it does something", "[enclosure]") {
    const std::string plain = box + "[cavity]\nwall = 3\n";
    const BuiltJob built = build_job(recipe_of(plain));
    REQUIRE(built.cavities->count == 1);
    // Roofs rise by 0.2 mm for 0.225 mm; the walls are somewhat thicker than 3 mm.
    const auto hollow = [](double side) { return side * side * (side - side / 2 * 0.2 / 0.225 * 2 / 3); };
    REQUIRE(built.cavities->volume < hollow(14));
    REQUIRE(built.cavities->volume > hollow(13));
    REQUIRE(built.job.part->value({0, 0, -5}) > 0);
    REQUIRE(built.job.part->value({0, 0, -7.5}) < 0);
    REQUIRE(built.job.part->value({7.5, 0, -5}) < 0);
    REQUIRE(built.before_cavities->value({0, 0, -5}) < 0);

    REQUIRE(cavities_of(box + "[cavity]\nwall = 2\n").volume > built.cavities->volume);
    REQUIRE(cavities_of(plain + "overhang = 0.4\n").volume > built.cavities->volume);
    REQUIRE(cavities_of(plain + "chamber = 4\n").count > 1);
    REQUIRE(cavities_of(plain + "pitch = 0.2\n").volume != built.cavities->volume);
    const HollowReport none = cavities_of(plain + "least = 3000\n");
    REQUIRE(none.count == 0);
    REQUIRE(none.left_solid == 1);
    for (const char* key : {"overhang = 0.4\n", "chamber = 4\n", "pitch = 0.2\n", "least = 3\n"}) {
        REQUIRE(identity_of(plain + key) != identity_of(plain));
    }
    REQUIRE(identity_of(plain) != identity_of(box));
    REQUIRE(identity_of(plain + "[support]\nkind = \"none\"\noverhang = 0.1\n") != identity_of(plain));
}

TEST_CASE("a cavity's wall and overhang hold as printed", "[enclosure]") {
    const std::string half =
        "[part]\nshape = \"box\"\nsize = [10, 10, 10]\n[layers]\nheight = 0.2\n[printer]\nprofile = "
        "\"marlin\"\n[process]\nscale = [2, 2, 2]\n[cavity]\nwall = 3\n";
    const HollowReport scaled = cavities_of(half), whole = cavities_of(box + "[cavity]\nwall = 3\n");
    REQUIRE(scaled.volume == Approx(whole.volume).epsilon(1e-3));
    REQUIRE(scaled.part_volume == Approx(whole.part_volume).epsilon(1e-3));
}

TEST_CASE("thin layers share their cavities", "[enclosure]") {
    const std::string resin =
        "[part]\nshape = \"sphere\"\nradius = 6\n[layers]\nheight = 0.05\n[cavity]\nwall = 1\n";
    const HollowReport report = cavities_of(resin);
    REQUIRE(report.count == 1);
    // Half a ball under a cone of 45 degrees.
    REQUIRE(report.volume < 3.14159265 * 5 * 5 * 5);
    REQUIRE(report.volume > 3.14159265 * 4.5 * 4.5 * 4.5);
}

TEST_CASE("no supports stand in a cavity", "[enclosure]") {
    const Recipe recipe = recipe_of(box + "[cavity]\nwall = 3\n[support]\noverhang = 0.2\n");
    BuiltJob built = build_job(recipe);
    SupportOptions options;
    options.plans.clear();
    options.threads = 1;
    const auto supports = add_supports(recipe, built, options);
    REQUIRE(supports->plan.scaffold.points.empty());
}

TEST_CASE("a shield stands about the print, and every key of it does something", "[enclosure]") {
    const std::string plain = box + "[shield]\ngap = 2\n";
    const Recipe recipe = recipe_of(plain);
    Job job = build_job(recipe).job;
    const Box before = job.bounds;
    const auto shield = add_shield(recipe, job, {1, nullptr});
    // Its corners are round.
    REQUIRE(shield->volume > (4 * 20 + 3.14 * 4) * 20 * 0.9);
    REQUIRE(shield->volume < 4 * 26 * 20 * 1.2);
    REQUIRE(job.supports->value({12.7, 0, 0}) < 0);
    REQUIRE(job.supports->value({11.9, 0, 0}) > 0);
    REQUIRE(job.supports->value({14.2, 0, 0}) > 0);
    REQUIRE(job.bounds.hi.x > before.hi.x + 2.9);
    REQUIRE(job.bounds.hi.x < before.hi.x + 3.5);
    REQUIRE(job.bounds.hi.z == before.hi.z);
    REQUIRE(shield_of(box + "[shield]\ngap = 4\n") > shield->volume);
    REQUIRE(shield_of(plain + "wall = 2\n") > shield->volume * 1.5);
    REQUIRE(shield_of(plain + "pitch = 0.2\n") != shield->volume);
    const std::string mushroom =
        "[[field]]\nname = \"m\"\nkind = \"formula\"\nbounds = [[-6, -6, 0], [6, 6, 10]]\nformula = "
        "\"max(max(min(hypot(x, y) - 1, max(hypot(x, y) - 6, 8 - z)), -z), z - 10)\"\n"
        "[part]\nfield = \"m\"\n[layers]\nheight = 0.2\n[printer]\nprofile = \"marlin\"\n"
        "[shield]\ngap = 1\npitch = 0.1\n";
    REQUIRE(shield_of(mushroom + "overhang = 0.4\n") < shield_of(mushroom));
    REQUIRE(identity_of(plain) != identity_of(box));
}

TEST_CASE("cavities and shields are refused where they make no sense", "[enclosure]") {
    CHECK(mentions(complaint_about(box + "[cavity]\n"), "cavity.wall: missing"));
    CHECK(mentions(complaint_about(box + "[shield]\nwall = 1\n"), "shield.gap: missing"));
    CHECK(mentions(complaint_about(box + "[cavity]\nwall = 2\n[skin]\nthickness = 1\n"),
                   "test.toml:9: cavity.wall: a part with a skin cannot have cavities"));
    CHECK(mentions(complaint_about(box + "[cavity]\nwall = 2\n[foam]\ncell = 4\nbeam = 0.5\n"),
                   "a part with foam cannot have cavities"));
    CHECK(
        mentions(complaint_about("[part]\nshape = \"sphere\"\nradius = 5\n[printer]\nkind = \"svg\"\nkerf = "
                                 "0.2\n[shield]\ngap = 1\n"),
                 "a printer that cuts sheets cannot make a shield"));
    CHECK(mentions(complaint_about(box + "[cavity]\nwall = 3\npitch = 50\n"), "[cavity]: "));
}

}  // namespace build_enclosure_test
