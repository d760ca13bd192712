// Names and formulas of a recipe: every way to be wrong is told once, with its place.
#include "recipe/recipe_formulas.h"

#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "recipe/recipe_draft.h"

namespace recipe_formulas_test {

using namespace lamella;

namespace {

const std::string sphere = "[part]\nshape = \"sphere\"\nradius = 10\n";

std::string complaint(const std::string& text) {
    RecipeDraft draft;
    draft.read_text(text, "test.toml");
    try {
        draft.finish();
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

std::string grading(const std::string& name, const std::string& formula) {
    return "[[grading]]\nname = \"" + name + "\"\nkind = \"formula\"\nformula = \"" + formula + "\"\n";
}

std::string field(const std::string& name, const std::string& formula) {
    return "[[field]]\nname = \"" + name + "\"\nformula = \"" + formula + "\"\n";
}

std::string foam(const std::string& cell) { return "[foam]\ncell = \"" + cell + "\"\nbeam = 0.2\n"; }

bool mentions(const std::string& text, const std::string& part) {
    UNSCOPED_INFO(text);
    return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("formulas may use the place, the depth, gradings and, after the cell, the cell") {
    CHECK(complaint(
              sphere + grading("a", "x + d") + grading("b", "2 * a") +
              "[foam]\ncell = \"clamp(1.5 + 0.2*z + b, 2, 8)\"\nbeam = \"0.1 * cell\"\n[skin]\nthickness = "
              "\"0.8 + 0.01*z\"\n") == "");
    CHECK(complaint(sphere + foam("1 + cell")) ==
          "test.toml:5: foam.cell: column 5: unknown name `cell`; known: x, y, z, d");
}

TEST_CASE("a formula's mistake is told with file, line, key and column") {
    CHECK(mentions(complaint(sphere + foam("2 + * z")), "test.toml:5: foam.cell: column 5: "));
    CHECK(mentions(complaint(sphere + grading("bone", "x") + foam("1 + bnoe")),
                   "test.toml:9: foam.cell: column 5: unknown name `bnoe`, did you mean `bone`?"));
    CHECK(mentions(complaint(sphere + foam(" ")), "test.toml:5: foam.cell: the formula is empty"));
    CHECK(mentions(complaint(sphere + "[skin]\nthickness = \"0.8 +\"\n"),
                   "test.toml:5: skin.thickness: column"));
}

TEST_CASE("names are identifiers of their own") {
    for (const std::string bad : {"2a", "a-b", "a.b", "\xc3\xa4"}) {
        CHECK(mentions(complaint(sphere + grading(bad, "x")),
                       "test.toml:4: grading.name: \"" + bad + "\" is not a valid name"));
    }
    CHECK(mentions(complaint(sphere + grading("z", "x")),
                   "`z` is reserved: it means a coordinate in formulas"));
    CHECK(mentions(complaint(sphere + grading("d", "x")),
                   "`d` is reserved: it means the depth below the surface in formulas"));
    CHECK(mentions(complaint(sphere + grading("cell", "x")),
                   "`cell` is reserved: it means the size of the foam's cell"));
    CHECK(mentions(complaint(sphere + grading("clamp", "x")),
                   "`clamp` is reserved: it means a function in formulas"));
    CHECK(mentions(complaint(sphere + grading("pi", "x")),
                   "`pi` is reserved: it means a constant in formulas"));
    CHECK(
        mentions(complaint(sphere + grading("a", "x") + grading("a", "y")),
                 "test.toml:8: grading.name: `a` is the name of another [[grading]] (test.toml:4: grading)"));
}

TEST_CASE("gradings that lead back to themselves are refused, with the way round") {
    CHECK(complaint(sphere + grading("a", "a + 1")) ==
          "test.toml:4: grading: `a` uses `a`; accepted: gradings that do not depend on themselves");
    CHECK(mentions(complaint(sphere + grading("a", "b") + grading("b", "c") + grading("c", "a")),
                   "`a` uses `b`, which uses `c`, which uses `a`"));
    std::string chain = grading("g0", "x");
    for (int i = 1; i < 16; ++i) {
        chain += grading("g" + std::to_string(i), "g" + std::to_string(i - 1));
    }
    CHECK(complaint(sphere + chain) == "");
    CHECK(mentions(complaint(sphere + chain + grading("g16", "g15")), "more than 16 deep"));
}

TEST_CASE("a field's formula cannot use the depth below the surface that it makes") {
    CHECK(mentions(
        complaint(field("f", "x + d")),
        "test.toml:3: field.formula: uses the depth `d` below the surface, but defines that surface itself"));
    CHECK(mentions(complaint(field("f", "x + a") + grading("b", "d") + grading("a", "b")),
                   "test.toml:3: field.formula: `a` depends on the depth `d`"));
    CHECK(complaint(field("f", "x + a") + grading("a", "y")) == "");
}

TEST_CASE("the body is a field by name, or the only one there is") {
    CHECK(mentions(complaint(field("one", "x") + field("two", "y")),
                   "accepted: part.field / --field with the name of one of the 2 [[field]]"));
    CHECK(mentions(complaint("[part]\nfield = \"tow\"\n" + field("one", "x") + field("two", "y")),
                   "no [[field]] is named \"tow\", did you mean `two`?"));
    CHECK(mentions(complaint(sphere + "field = \"one\"\n" + field("one", "x")), "conflicts with"));
    RecipeDraft draft;
    draft.read_text(field("one", "x"), "test.toml");
    const Recipe recipe = draft.finish();
    CHECK(recipe.part.field == "one");
    CHECK(recipe.part.name == "one");
}

TEST_CASE("each kind has its own keys") {
    const std::string volume = "[[grading]]\nname = \"g\"\nkind = \"volume\"\n";
    CHECK(
        mentions(complaint(sphere + volume), "test.toml:4: grading.file: missing, required by kind volume"));
    CHECK(
        mentions(complaint(sphere + volume + "file = \"a.nrrd\"\nradius = 2\n"),
                 "test.toml:8: grading.radius: does not apply to kind volume; accepted: file, box, channel"));
    const std::string table = "[[grading]]\nname = \"g\"\nkind = \"table\"\nalong = \"z\"\n";
    CHECK(mentions(complaint(sphere + table), "grading.rows: missing, required by kind table (or file)"));
    CHECK(mentions(complaint(sphere + table + "rows = [[0, 1]]\nfile = \"t.csv\"\n"),
                   "test.toml:9: grading.file: conflicts with test.toml:8: grading.rows"));
    CHECK(mentions(complaint(sphere + "[[grading]]\nname = \"g\"\n"),
                   "grading.kind: missing, required by [[grading]]"));
    CHECK(mentions(complaint(sphere + "[[grading]]\nkind = \"constant\"\nvalue = 1\n"),
                   "grading.name: missing"));
    CHECK(mentions(
        complaint(sphere + "[grading]\nname = \"g\"\n"),
        "test.toml:4: grading: a table was found; accepted: a section [[grading]] with keys, as often"));
    CHECK(mentions(complaint(sphere + "[foam]\nkind = \"gyroid\"\ncell = 3\nbeam = 0.2\n"),
                   "foam.beam: does not apply to kind gyroid; accepted: cell, wall, network"));
    CHECK(mentions(complaint(sphere + "[foam]\nkind = \"lattice\"\ncell = 3\nbeam = 0.2\n"),
                   "foam.unit_cell: missing, required by kind lattice (or struts)"));
}

TEST_CASE("rows of numbers have the right length and number") {
    const std::string head = "[[grading]]\nname = \"g\"\nkind = \"volume\"\nfile = \"a.nrrd\"\nbox = ";
    CHECK(complaint(sphere + head + "[[0, 0, 0], [1, 1, 1]]\n") == "");
    CHECK(mentions(complaint(sphere + head + "[[0, 0, 0]]\n"),
                   "test.toml:8: grading.box: the number of rows is 1 instead of 2; accepted: two corners"));
    CHECK(mentions(complaint(sphere + head + "[[0, 0], [1, 1]]\n"),
                   "the number of values in a row is 2 instead of 3"));
    CHECK(mentions(complaint(sphere + head + "[[0, 0, nan], [1, 1, 1]]\n"), "nan is not a finite number"));
    CHECK(mentions(complaint(sphere + head + "3\n"), "a whole number was found"));
    CHECK(mentions(complaint(sphere + head + "[0, 0, 0, 1, 1, 1]\n"), "an array of 6 was found"));
}

TEST_CASE("constants lie within the printable range") {
    const std::string constant = "[foam]\ncell = 3\nbeam = 0.2\n";
    CHECK(mentions(
        complaint(sphere + constant + "beam_min = 0.3\n"),
        "test.toml:6: foam.beam: 0.2 mm lies outside foam.beam_min and foam.beam_max; accepted: 0.3 to "
        "500 mm"));
    CHECK(mentions(complaint(sphere + constant + "cell_min = 4\ncell_max = 2\n"),
                   "test.toml:7: foam.cell_min: 4 mm is more than test.toml:8: foam.cell_max, 2 mm"));
    CHECK(mentions(complaint(sphere + constant + "turn = [0, 0, 30]\n"),
                   "test.toml:7: foam.turn: has no effect without a stretch"));
}

TEST_CASE("a flag takes formulas like its key") {
    RecipeDraft draft;
    draft.read_text(sphere + foam("2"), "test.toml");
    draft.assign_flag(*find_setting("foam", "cell"), "2 + 0.1*z");
    const Recipe recipe = draft.finish();
    REQUIRE(recipe.foam->cell.is_formula());
    CHECK(recipe.foam->cell.formula() == "2 + 0.1*z");
    CHECK(recipe.foam->cell.where == "--cell");
    RecipeDraft wrong;
    wrong.read_text(sphere + foam("2"), "test.toml");
    wrong.assign_flag(*find_setting("foam", "beam"), "three");
    try {
        wrong.finish();
        FAIL("`three` is no name");
    } catch (const InputError& error) {
        CHECK(mentions(error.what(), "--beam: column 1: unknown name `three`"));
    }
}

}  // namespace recipe_formulas_test
