// What a recipe may say of regions, and what it is told where it says something else.
#include "recipe/recipe_regions.h"

#include <catch2/catch.hpp>

#include "recipe/identity.h"
#include "recipe/recipe_formulas.h"
#include "tests/app/commands/recipes.h"

namespace recipe_regions_test {

using namespace lamella;

namespace {

const std::string block =
    "[part]\nshape = \"box\"\nsize = [20, 20, 10]\n"
    "[[field]]\nname = \"heel\"\nkind = \"sphere\"\nradius = 4\n"
    "[[field]]\nname = \"slab\"\nformula = \"abs(z) - 1\"\n";
const std::string foam = "[foam]\ncell = 3\nbeam = 0.3\n";

std::string complaint(const std::string& text) { return complaint_about(block + text); }

std::vector<std::string> warned(const std::string& text) {
    return build_job(recipe_of(block + text)).regions.warnings;
}

std::string region(const std::string& field, const std::string& rest) {
    return "[[region]]\nfield = \"" + field + "\"\nmake = " + rest + "\n";
}

}  // namespace

TEST_CASE("a region of an unknown field is told the known ones") {
    CHECK(
        mentions(complaint(foam + region("hel", "\"solid\"")),
                 "region.field: no [[field]] is named \"hel\", did you mean `heel`?; accepted: heel, slab"));
}

TEST_CASE("a region must say what it makes, and of which field") {
    CHECK(mentions(complaint(foam + "[[region]]\nfield = \"heel\"\n"),
                   "region.make: missing, required by [[region]]"));
    CHECK(mentions(complaint(foam + "[[region]]\nmake = \"solid\"\n"),
                   "region.field: missing, required by make solid"));
    CHECK(mentions(complaint(foam + region("heel", "\"hollow\"")),
                   "accepted: one of solid, empty, foam, skin"));
}

TEST_CASE("keys that belong to another kind of region are refused by name") {
    CHECK(mentions(complaint(foam + region("heel", "\"solid\"\ncell = 2")),
                   "region.cell: does not apply to make solid; accepted: field, blend"));
    CHECK(mentions(complaint(foam + region("heel", "\"foam\"\ncell = 2\nthickness = 1")),
                   "region.thickness: does not apply to make foam"));
    CHECK(mentions(complaint(foam + region("heel", "\"skin\"")),
                   "region.thickness: missing, required by make skin"));
}

TEST_CASE("the keys of a skin without thickness hold where a region gives it one") {
    const std::string skin = "[skin]\nthickness = 0\nside = \"outside\"\nthickness_max = 0.5\n";
    const Recipe recipe = recipe_of(block + foam + skin + region("heel", "\"skin\"\nthickness = 0.4"));
    REQUIRE(recipe.skin);
    CHECK(recipe.skin->side == SkinSide::outside);
    CHECK(recipe.skin->thickness_max == 0.5);
    CHECK(!recipe_of(block + foam + skin).skin);
}

TEST_CASE("a region of foam needs a foam, a number, and one that this foam has") {
    CHECK(mentions(complaint(region("heel", "\"foam\"\ncell = 2")),
                   "there is none; accepted: a section [foam]"));
    CHECK(mentions(complaint(foam + region("heel", "\"foam\"")), "sets no number of the foam"));
    CHECK(mentions(complaint(foam + region("heel", "\"foam\"\nwall = 0.2")),
                   "region.wall: does not apply to foam.kind voronoi"));
    CHECK(complaint("[foam]\nkind = \"gyroid\"\ncell = 3\nwall = 0.4\n" +
                    region("heel", "\"foam\"\nwall = 0.8"))
              .empty());
}

TEST_CASE("a region's numbers keep the limits of what they replace") {
    const std::string limited = foam + "cell_min = 2\ncell_max = 4\n";
    CHECK(mentions(complaint(limited + region("heel", "\"foam\"\ncell = 1.5")),
                   "region.cell: 1.5 lies outside foam.cell_min and foam.cell_max; accepted: 2 to 4"));
    const BuiltJob built =
        build_job(recipe_of(block + limited + region("heel", "\"foam\"\ncell = \"1 + 0*x\"")));
    CHECK(built.foam->cell.made->at(dvec3(0)) == 2);
    CHECK(built.foam->cell.asked->at(dvec3(0)) == 1);
    CHECK(mentions(
        complaint("[skin]\nthickness = 1\nthickness_max = 2\n" + region("heel", "\"skin\"\nthickness = 3")),
        "region.thickness: 3 lies outside skin.thickness_min and skin.thickness_max"));
}

TEST_CASE("wrong formulas of a region say where they stand") {
    CHECK(mentions(complaint(foam + region("heel", "\"foam\"\ncell = \"2 + q\"")), "region.cell"));
    CHECK(mentions(complaint(foam + region("heel", "\"foam\"\ncell = \"cell/2\"")), "region.cell"));
    CHECK(complaint(foam + region("heel", "\"foam\"\nbeam = \"cell/8 + d/100\"")).empty());
}

TEST_CASE("a region that does not touch the part, or changes nothing in it, is named in a warning") {
    const std::string far = "[[field]]\nname = \"far\"\nkind = \"sphere\"\nradius = 1\nat = [50, 0, 0]\n";
    // The body's corner lies within the ball's box but not within the ball.
    const std::string corner =
        "[[field]]\nname = \"corner\"\nkind = \"sphere\"\nradius = 1\nat = [10.6, 10.6, 5.6]\n";
    const auto lines = warned(far + corner + foam + region("far", "\"solid\"") + region("heel", "\"solid\"") +
                              region("corner", "\"empty\""));
    REQUIRE(lines.size() == 2);
    CHECK(lines[0] == "region 1 (`far`) does not touch the part and changes nothing");
    CHECK(lines[1] == "region 3 (`corner`) does not touch the part and changes nothing");
    CHECK(warned(foam + region("heel", "\"solid\"")).empty());
    REQUIRE(warned(region("heel", "\"solid\"")).size() == 1);
    CHECK(mentions(warned(region("heel", "\"solid\""))[0], "solid where the part is solid"));
}

TEST_CASE("empty regions that remove the whole part are refused, unless a later one puts something back") {
    const std::string all = "[[field]]\nname = \"all\"\nkind = \"box\"\nsize = [20, 20, 10]\n";
    CHECK(mentions(complaint(all + foam + region("all", "\"empty\"")),
                   "the empty regions remove the whole part"));
    CHECK(complaint(all + foam + region("all", "\"empty\"") + region("heel", "\"solid\"")).empty());
    CHECK(mentions(complaint(all + foam + region("heel", "\"solid\"") + region("all", "\"empty\"")),
                   "remove the whole part"));
}

TEST_CASE("values that jump cannot blend, and are told so") {
    const std::string jump = "[[field]]\nname = \"jump\"\nformula = \"x > 2 ? -1 : 1\"\n";
    CHECK(mentions(complaint(jump + foam + region("jump", "\"solid\"\nblend = 1")), "accepted: blend = 0"));
    CHECK(complaint(jump + foam + region("jump", "\"solid\"")).empty());
}

TEST_CASE("fields and gradings that only regions use are used") {
    const std::string text = block + "[[grading]]\nname = \"g\"\nkind = \"constant\"\nvalue = 2\n" + foam;
    CHECK(unused_entries(recipe_of(text)) ==
          "nothing uses [[field]] `heel`, [[field]] `slab`, [[grading]] `g`");
    CHECK(unused_entries(
              recipe_of(text + region("heel", "\"foam\"\ncell = \"g\"") + region("slab", "\"empty\"")))
              .empty());
}

TEST_CASE("every key of a region is part of the job's identity") {
    const auto identity = [](const std::string& rest) {
        return job_identity(recipe_of(block + foam + region("heel", rest)));
    };
    const std::string plain = identity("\"foam\"\ncell = 2");
    CHECK(plain == identity("\"foam\"\ncell = 2"));
    for (const char* other :
         {"\"foam\"\ncell = 2.5", "\"foam\"\ncell = 2\nblend = 1", "\"foam\"\ncell = 2\nbeam = 0.2",
          "\"solid\"", "\"empty\"", "\"skin\"\nthickness = 0.5"}) {
        CHECK(identity(other) != plain);
    }
}

}  // namespace recipe_regions_test
