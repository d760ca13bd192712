// What a recipe may say of discrete elements, and what it is told where it says something else.
#include <catch2/catch.hpp>

#include "recipe/recipe_formulas.h"
#include "tests/app/commands/mentions.h"
#include "tests/app/commands/recipes.h"

namespace recipe_elements_test {

using namespace lamella;

namespace {

const std::string part = "[part]\nshape = \"box\"\nsize = [60, 20, 10]\n";
const std::string loads = "[[load]]\nface = \"+x\"\nforce = [0, -10, 0]\n[[anchor]]\nface = \"-x\"\n";
const std::string stick = "[[element]]\nlength = 8\nwidth = 2\n";
const std::string placed = "[elements]\ncount = 30\n";

std::string told(const std::string& text) {
    try {
        recipe_of(text, "p.toml");
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("elements have shapes of four kinds", "[elements]") {
    const Recipe recipe =
        recipe_of(part + loads + stick + "[[element]]\nkind = \"ring\"\ndiameter = 6\nwidth = 1\n" +
                      "[[element]]\nkind = \"outline\"\ncorners = [[0, 0], [2, 0], [0, 2]]\nthickness = 1\n" +
                      "[[field]]\nname = \"ball\"\nkind = \"sphere\"\nradius = 2\n" +
                      "[[element]]\nkind = \"field\"\nfield = \"ball\"\n" + placed + "dimensions = 2\n",
                  "p.toml");
    REQUIRE(recipe.element_shapes.size() == 4);
    CHECK(recipe.element_shapes[0].kind == ElementKind::stick);
    CHECK(recipe.element_shapes[1].diameter == 6);
    CHECK(recipe.element_shapes[2].corners.size() == 3);
    CHECK(recipe.element_shapes[3].field == "ball");
    CHECK(recipe.element_shapes[3].where == "p.toml:24: element");
    CHECK(recipe.elements->count == 30);
    CHECK(recipe.elements->dimensions == 2);
    CHECK(unused_entries(recipe).empty());
}

TEST_CASE("elements that lack something are told what", "[elements]") {
    CHECK(told(part + loads + stick + placed).empty());
    CHECK(mentions(told(part + loads + stick),
                   "a shape whose copies nothing places; accepted: a section [elements]"));
    CHECK(mentions(told(part + loads + placed),
                   "there is no shape to copy; accepted: one or more [[element]]"));
    CHECK(told(part + stick + placed).empty());  // spread evenly
    CHECK(mentions(told(part + "[[anchor]]\nface = \"-x\"\n" + stick + placed), "nothing loads the body"));
    CHECK(mentions(told(part + "[[load]]\nface = \"+x\"\nforce = [0, -10, 0]\n" + stick + placed),
                   "nothing holds the body"));
    CHECK(mentions(told(part + loads + stick + placed + "density = \"x\"\n"),
                   "elements.density: loads decide where copies are"));
    CHECK(mentions(told(part + loads + stick + placed + "[optimize]\n"), "conflicts with [optimize]"));
    CHECK(mentions(told(part + loads + placed + "[[element]]\nlength = 8\n"),
                   "element.width: missing, required by kind stick"));
    CHECK(mentions(told(part + loads + placed + "[[element]]\nlength = 8\nwidth = 9\n"),
                   "element.length: 8 mm is not more than the width, 9 mm"));
    CHECK(mentions(told(part + loads + placed + "[[element]]\nkind = \"ring\"\ndiameter = 2\nwidth = 1\n"),
                   "has no hole"));
    CHECK(mentions(
        told(part + loads + placed + "[[element]]\nkind = \"outline\"\ncorners = [[0, 0], [1, 0]]\n"),
        "2 corners enclose nothing"));
    CHECK(mentions(
        told(part + loads + placed + "[[element]]\nkind = \"outline\"\ncorners = [[0, 0], [1, 0], [0, 1]]\n"),
        "an outline has a thickness in three dimensions"));
    CHECK(
        mentions(told(part + loads + placed + "[[element]]\nkind = \"field\"\nfield = \"leaf\"\n"), "leaf"));
    CHECK(mentions(told(part + loads + stick + placed + "scale_min = 2\n"),
                   "elements.scale_max, 1; accepted: a minimum not above the maximum"));
    CHECK(
        mentions(told(part + loads + stick + "[elements]\ncount = 0\n"), "accepted: a whole number from 1"));
    CHECK(mentions(told(part + stick + placed + "along = [\"q\", 0, 1]\n"), "elements.along"));
}

TEST_CASE("a skin of elements needs them, in space", "[elements]") {
    const std::string skin = "[skin]\nthickness = 1\npattern = \"elements\"\n";
    const std::string leaf = "[[element]]\nkind = \"outline\"\ncorners = [[0, 0], [4, 0], [0, 2]]\n";
    CHECK(told(part + skin + leaf + placed).empty());  // outlines are as thick as the skin
    CHECK(told(part + loads + skin + leaf + placed + "density = \"x + 40\"\n").empty());
    CHECK(mentions(told(part + skin), "p.toml:6: skin.pattern: nothing says how many elements"));
    CHECK(mentions(told(part + skin + placed), "there is no shape to copy"));
    CHECK(mentions(told(part + skin + leaf + placed + "dimensions = 2\n"),
                   "elements of a skin lie in space; accepted: 3"));
}

TEST_CASE("a grading that only elements use is used", "[elements]") {
    const Recipe recipe = recipe_of(part + stick + placed +
                                        "density = \"few\"\nalong = [\"way\", 1, 0]\n"
                                        "[[grading]]\nname = \"few\"\nkind = \"formula\"\n"
                                        "formula = \"1 + x/60\"\n"
                                        "[[grading]]\nname = \"way\"\nkind = \"formula\"\nformula = \"y\"\n",
                                    "p.toml");
    CHECK(unused_entries(recipe).empty());
}

}  // namespace recipe_elements_test
